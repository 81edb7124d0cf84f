// Gauze: a sheet of threads that light passes between, is reflected from, and shines through. Functions only; directions
// are unit vectors in the tangent frame (z = normal, on the eye's side).
//
// An optical depth says how much yarn lies along a direction; 1 - e^-depth of the light meets a thread. What is met
// scatters in proportion to how much of the sheet eye and light both meet, on the light's side or through the sheet in
// the ratio of single scattering (Wang et al. 2022, "SpongeCake: A Layered Microfacet Appearance Model", for a layer
// without a preferred direction). All that is met, and nothing more, is reflected, transmitted or absorbed.
#ifndef VAIR_GAUZE_GLSL
#define VAIR_GAUZE_GLSL

// (1 - e^-x) / x for x >= 0; by its series where that cancels.
float gauze_phi1(float x) {
    if (x >= 1.0) {
        return (1.0 - exp(-min(x, 80.0))) / x;
    }
    float sum = 1.0 - x / 10.0;
    sum = 1.0 - x / 9.0 * sum;
    sum = 1.0 - x / 8.0 * sum;
    sum = 1.0 - x / 7.0 * sum;
    sum = 1.0 - x / 6.0 * sum;
    sum = 1.0 - x / 5.0 * sum;
    sum = 1.0 - x / 4.0 * sum;
    sum = 1.0 - x / 3.0 * sum;
    return 1.0 - x / 2.0 * sum;
}

// Depth of matted yarn along a direction of cosine mu in [0, 1], from that from the front; at most 60.
float gauze_matted_depth(float depth, float mu) {
    return min(depth / max(mu, 1e-7), 60.0);
}

// Depth of a grid of round threads, `cover` = diameter over pitch in [0, 1], along w, w.z in [0, 1]; at most 60. Seen
// aslant along x a thread along y spans sqrt(1 + (x / z)^2) of its diameter.
float gauze_crossed_depth(float cover, vec3 w) {
    vec2 slope = w.xy / max(w.z, 1e-7);
    vec2 open = max(1.0 - cover * sqrt(1.0 + slope * slope), 0.0);
    return min(-log(max(open.x * open.y, 1e-30)), 60.0);
}

// Share of the light along a depth that meets a thread.
float gauze_opacity(float depth) {
    return min(depth * gauze_phi1(depth), 1.0);
}

// Classic: sin(theta)^exponent, 0 is opaque; mu in [0, 1]. Nothing is hidden from the front.
float gauze_classic_opacity(float exponent, float mu) {
    float sine_squared = max(1.0 - mu * mu, 0.0);
    // Some devices say 0 to the power of 0 is 0.
    return exponent > 0.0 ? pow(sine_squared, 0.5 * exponent) : 1.0;
}

// Share of scattered light that goes through the sheet.
float gauze_through(float depth_v, float depth_l) {
    float through = exp(-min(depth_v, depth_l)) * gauze_phi1(abs(depth_v - depth_l));
    return through / (gauze_phi1(depth_v + depth_l) + through);
}

// Share of the sheet that both eye and light meet, opacities in [0, 1]: correlated as the heights in Smith's masking are
// (Heitz 2014), so that it is at most the smaller of the two.
float gauze_met_by_both(float opacity_v, float opacity_l) {
    float both = opacity_v * opacity_l;
    return both / max(opacity_v + opacity_l - both, 1e-15);
}

// Gauze seen from one direction.
struct GauzeSurface {
    vec3 diffuse;     // albedo of the threads below their highlight, linear
    float depth;      // along the view
    vec3 coupled;     // diffuse A(v) (1 - E(v)) / (pi average), A = opacity, E = albedo of the highlight
    float opacity;    // A(v)
};

// mean_opacity = cosine-weighted mean of the opacity over all directions; E(v) and the mean of E are those of the lobe.
GauzeSurface gauze_surface(vec3 diffuse, float depth, float mean_opacity, vec3 lobe_albedo, vec3 lobe_average) {
    GauzeSurface s;
    s.diffuse = diffuse;
    s.depth = depth;
    s.opacity = gauze_opacity(depth);
    vec3 average = max(mean_opacity * (1.0 - lobe_average), 1e-6);
    s.coupled = diffuse * (1.0 - lobe_albedo) * (s.opacity * 0.318309886) / average;
    return s;
}

// Diffuse scattering times |mu_l|: mu_l in [-1, 1] is negative for light from behind; depth_l and the lobe's albedo are
// those of the light's direction, mirrored to the eye's side.
vec3 gauze_diffuse_times_cosine(GauzeSurface s, float depth_l, float mu_l, vec3 lobe_albedo_l) {
    float through = gauze_through(s.depth, depth_l);
    float side = mu_l > 0.0 ? 1.0 - through : through;
    return s.coupled * (1.0 - lobe_albedo_l) * (gauze_opacity(depth_l) * side * abs(mu_l));
}

// Radiance, premultiplied: mirrored = mean radiance that the highlight sees, before and behind = that of either side, of
// which the share `through` comes from behind.
vec3 gauze_ambient(GauzeSurface s, vec3 lobe_albedo, vec3 mirrored, vec3 before, vec3 behind, float through) {
    vec3 scattered = s.diffuse * (1.0 - lobe_albedo) * s.opacity;
    return lobe_albedo * gauze_met_by_both(s.opacity, s.opacity) * mirrored + scattered * mix(before, behind, through);
}

#endif
