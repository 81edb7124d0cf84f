// Ambient occlusion from what stands above a surface, slice by slice around the view direction.
//
// A slice is a plane through the point and the eye. On each of its two sides the light comes from the elevations between
// the tangent plane and the direction to the eye; measured from the tangent plane, not from the eye, a flat floor hides
// nothing of itself, whatever rounding and the grid of pixels do to its samples. Azimuths around the direction to the eye
// are uniform, so that the slices' sum is the cosine-weighted integral over the hemisphere.
//
// Sources: Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion" (the arc, its weight);
// Bavoil, Sainz & Dimitrov 2008, "Image-Space Horizon-Based Ambient Occlusion" (each rise of the horizon with the weight
// of its own distance).
#ifndef VAIR_HORIZON_GLSL
#define VAIR_HORIZON_GLSL

struct HorizonSlice {
    vec3 tangent;              // unit, in the tangent plane and in the slice, on the side of `along`
    float normal_angle;        // of the normal in the slice from the eye towards `along`, [-pi/2, pi/2]
    float weight;              // length of the normal's projection on the slice, [0, 1]
};

// The slice through unit `along`, across unit `to_eye`, at a surface with a unit `normal`.
HorizonSlice horizon_slice(vec3 along, vec3 to_eye, vec3 normal) {
    vec2 in_slice = vec2(dot(normal, along), max(dot(normal, to_eye), 0.0));
    float weight = length(in_slice);
    // Seen exactly edge on the slice weighs nothing: any angle will do.
    vec2 unit = weight > 0.0 ? in_slice / weight : vec2(0.0, 1.0);
    return HorizonSlice(along * unit.y - to_eye * unit.x, atan(unit.x, unit.y), weight);
}

// Elevation of a sample over the tangent plane, radians, as seen in the slice: 0 for what lies below the plane, at most
// `highest`, the direction to the eye. What the sample lies off the slice is taken out along the tangent plane.
float horizon_elevation(vec3 to_sample, vec3 normal, vec3 tangent, float weight, float highest) {
    float height = dot(to_sample, normal);
    // A sample at the point itself hides nothing.
    if (height <= 0.0) { return 0.0; }
    return clamp(atan(height, weight * dot(to_sample, tangent)), 0.0, highest);
}

// Cosine-weighted light of one side of a slice from the tangent plane up to an elevation in [0, pi/2 + normal_angle]; the
// other side has the opposite angle. All of both sides is cos(normal_angle) + normal_angle sin(normal_angle).
float horizon_arc(float elevation, float normal_angle) {
    return 0.5 * (sin(elevation) * sin(elevation - normal_angle) + elevation * sin(normal_angle));
}

// How much of the light what stands at a distance takes, in [0, 1]: nothing from `radius` on.
float horizon_falloff(float distance_squared, float radius) {
    return clamp(1.0 - distance_squared / (radius * radius), 0.0, 1.0);
}

#endif
