// Directional albedo of isotropic GGX (alpha = roughness^2 >= 1e-3, height-correlated Smith, Schlick with F90 = 1), and
// the terms that couple lobes by it. Functions only.
//
// Sources: Turquin 2019, "Practical multiple scattering compensation for microfacet models"; Kelemen & Szirmay-Kalos
// 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model". The polynomials are our own: minimax fits made by
// tools/fit_albedo.rs, which prints the text between the marks. Against quadrature over roughness 0..1, mu 1e-4..1:
// scale and bias within 0.0035, their sum within 0.8 % and never more than 0.1 % below the truth, as that would gain
// energy.
#ifndef VAIR_ALBEDO_GLSL
#define VAIR_ALBEDO_GLSL

// fit: begin
float ggx_fit_white(float t, float alpha) {
    vec4 a = vec4(1, alpha, alpha * alpha, alpha * alpha * alpha);
    float e = dot(vec4(0.287233, -2.551583, 0.709582, 4.108242), a);
    e = e * t + dot(vec4(0.093594, -2.738116, -2.969845, 9.253735), a);
    e = e * t + dot(vec4(-0.622450, 4.410277, -11.957410, 6.419553), a);
    e = e * t + dot(vec4(-0.294469, 4.836438, -5.953746, -3.894424), a);
    e = e * t + dot(vec4(0.351044, -1.928884, 8.953406, -10.180817), a);
    e = e * t + dot(vec4(0.293378, -2.328059, 7.013819, -5.395899), a);
    e = e * t + dot(vec4(0.083809, 0.076203, -0.068002, 0.043341), a);
    e = e * t + dot(vec4(-0.092234, 0.250815, -1.357835, 0.796592), a);
    e = e * t + dot(vec4(0.903279, 0.022874, -0.935792, 0.389064), a);
    return clamp(e, 0, 1);
}

float ggx_fit_fresnel_root(float mu, float t, float roughness) {
    vec4 r = vec4(1, roughness, roughness * roughness, roughness * roughness * roughness);
    float r4 = r.z * r.z;
    float q = 0;
    float row = 0;
    row = (1.089409);
    q = q * mu + row;
    row = (-25.713389);
    row = row * t + dot(vec2(23.573015, 0.414919), r.xy);
    q = q * mu + row;
    row = (6.096349);
    row = row * t + dot(vec2(-93.553053, 2.034242), r.xy);
    row = row * t + dot(vec3(88.625217, 3.333454, -55.901549), r.xyz);
    q = q * mu + row;
    row = (-1.770685);
    row = row * t + dot(vec2(56.574572, 2.651199), r.xy);
    row = row * t + dot(vec2(-197.288294, 78.438506), r.xy);
    row = row * t + dot(vec4(142.296127, -83.834733, -123.364889, 88.488368), r);
    q = q * mu + row;
    row = (-0.554991);
    row = row * t + dot(vec2(2.761230, -7.201235), r.xy);
    row = row * t + dot(vec2(-5.430829, 24.826340), r.xy);
    row = row * t + dot(vec2(3.232262, -21.047374), r.xy);
    row = row * t + dot(vec4(-1.002491, 3.648313, -119.456401, 114.955344), r) + r4 * (-41.175472);
    q = q * mu + row;
    row = (-0.000535);
    row = row * t + dot(vec2(0.004329, -0.101427), r.xy);
    row = row * t + dot(vec2(-0.000496, 0.055785), r.xy);
    row = row * t + dot(vec2(-0.003275, 0.070031), r.xy);
    row = row * t + dot(vec2(-0.000323, 0.038176), r.xy);
    row = row * t + dot(vec4(1.001252, -0.085464, -2.085277, 4.252159), r) + r4 * (-3.601074 + (1.189528) * r.y);
    q = q * mu + row;
    return clamp(q, 0, 1);
}

vec3 ggx_fit_averages(float r) {
    vec3 e = vec3(3.364856, 5.578325, 2.014068);
    e = e * r + vec3(-15.651216, -24.482990, -9.755738);
    e = e * r + vec3(30.141655, 42.199890, 19.868799);
    e = e * r + vec3(-30.805612, -36.866305, -21.735968);
    e = e * r + vec3(17.589826, 18.966109, 13.429080);
    e = e * r + vec3(-5.198344, -6.988919, -4.348308);
    e = e * r + vec3(0.539870, 1.071884, 0.515891);
    e = e * r + vec3(-0.024873, -0.069589, -0.026399);
    e = e * r + vec3(0.048477, 1.001445, 0.048539);
    return e;
}
// fit: end

// (E1, Q): albedo of the lobe with F = 1, and the share of it that Schlick's (1 - v.h)^5 takes. mu in [0, 1].
vec2 ggx_albedo_terms(float mu, float roughness) {
    float alpha = clamp(roughness * roughness, 1e-3, 1.0);
    float t = (mu - 0.7 * alpha) / (mu + 0.7 * alpha);
    float q = ggx_fit_fresnel_root(mu, t, sqrt(alpha));
    float q2 = q * q;
    return vec2(ggx_fit_white(t, alpha), q2 * q2 * q);
}

// (scale, bias): E(F0) = F0 scale + bias, single scattering.
vec2 ggx_directional_albedo(float mu, float roughness) {
    vec2 e = ggx_albedo_terms(mu, roughness);
    return vec2(e.x - e.x * e.y, e.x * e.y);
}

// Cosine-weighted averages over the hemisphere of (E1 Q, E1, Q).
vec3 ggx_average_terms(float roughness) {
    return ggx_fit_averages(clamp(roughness, 0.0316227766, 1.0));
}

// Cosine-weighted average of (scale, bias).
vec2 ggx_average_albedo(float roughness) {
    vec3 e = ggx_average_terms(roughness);
    return vec2(e.y - e.x, e.x);
}

// Factor on the single-scattering lobe that returns what scatters more than once; white_albedo = E1 = scale + bias.
vec3 standard_specular_compensation(vec3 f0, float white_albedo) {
    return 1.0 + f0 * ((1.0 - white_albedo) / max(white_albedo, 1e-3));
}

// Albedo of the compensated lobe, in [0, 1]; terms from ggx_albedo_terms.
vec3 standard_compensated_albedo(vec3 f0, vec2 terms) {
    return (f0 + (1.0 - f0) * terms.y) * (terms.x + f0 * (1.0 - terms.x));
}

// Its cosine-weighted average; terms from ggx_average_terms.
vec3 standard_average_compensated_albedo(vec3 f0, vec3 terms) {
    return terms.x + f0 * ((terms.y + terms.z - 2.0 * terms.x) + f0 * (1.0 - terms.y - terms.z + terms.x));
}

#endif
