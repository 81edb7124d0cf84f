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
    float e = dot(vec4(0.258558, -2.881536, 3.598019, 2.582419), a);
    e = e * t + dot(vec4(0.066954, -2.303169, -2.975984, 11.291102), a);
    e = e * t + dot(vec4(-0.556979, 4.938557, -16.450255, 11.801157), a);
    e = e * t + dot(vec4(-0.249110, 4.065050, -5.214154, -4.288520), a);
    e = e * t + dot(vec4(0.302645, -2.146196, 10.869357, -12.222284), a);
    e = e * t + dot(vec4(0.271185, -1.945187, 6.167630, -4.813019), a);
    e = e * t + dot(vec4(0.096197, 0.082651, -0.344921, 0.355322), a);
    e = e * t + dot(vec4(-0.089566, 0.213412, -1.257483, 0.723528), a);
    e = e * t + dot(vec4(0.902479, 0.027903, -0.943511, 0.392133), a);
    return clamp(e, 0, 1);
}

float ggx_fit_fresnel_root(float mu, float t, float roughness) {
    vec4 r = vec4(1, roughness, roughness * roughness, roughness * roughness * roughness);
    float r4 = r.z * r.z;
    float q = 0;
    float row = 0;
    row = (0.695283);
    q = q * mu + row;
    row = (-23.151736);
    row = row * t + dot(vec2(21.879659, -2.351075), r.xy);
    q = q * mu + row;
    row = (14.473044);
    row = row * t + dot(vec2(-119.045003, 15.796003), r.xy);
    row = row * t + dot(vec3(105.131617, -7.215779, -41.703588), r.xyz);
    q = q * mu + row;
    row = (-1.382776);
    row = row * t + dot(vec2(38.094449, 9.911753), r.xy);
    row = row * t + dot(vec2(-152.294184, 36.409146), r.xy);
    row = row * t + dot(vec4(115.556390, -50.084134, -144.152059, 83.205315), r);
    q = q * mu + row;
    row = (-0.505577);
    row = row * t + dot(vec2(2.809799, -5.443983), r.xy);
    row = row * t + dot(vec2(-5.615784, 21.540838), r.xy);
    row = row * t + dot(vec2(3.734180, -21.419273), r.xy);
    row = row * t + dot(vec4(-1.432840, 5.688540, -106.361340, 98.291582), r) + r4 * (-34.188032);
    q = q * mu + row;
    row = (-0.002441);
    row = row * t + dot(vec2(0.007338, -0.146336), r.xy);
    row = row * t + dot(vec2(0.000932, 0.068598), r.xy);
    row = row * t + dot(vec2(-0.005382, 0.104727), r.xy);
    row = row * t + dot(vec2(-0.000914, 0.053278), r.xy);
    row = row * t + dot(vec4(1.001383, -0.083347, -1.881845, 3.756912), r) + r4 * (-3.063555 + (0.976648) * r.y);
    q = q * mu + row;
    return clamp(q, 0, 1);
}

vec3 ggx_fit_averages(float r) {
    vec3 e = vec3(2.250733, 6.767213, 1.354829);
    e = e * r + vec3(-10.717233, -30.103130, -6.605183);
    e = e * r + vec3(21.201948, 53.013014, 13.806401);
    e = e * r + vec3(-22.320080, -47.721997, -15.710002);
    e = e * r + vec3(13.125257, 25.025307, 10.159562);
    e = e * r + vec3(-3.944161, -8.842134, -3.423791);
    e = e * r + vec3(0.378752, 1.358827, 0.403399);
    e = e * r + vec3(-0.019069, -0.088925, -0.023898);
    e = e * r + vec3(0.048442, 1.001863, 0.048577);
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
