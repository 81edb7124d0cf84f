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
    float e = dot(vec4(0.258578, -2.881759, 3.598297, 2.582619), a);
    e = e * t + dot(vec4(0.066959, -2.303348, -2.976214, 11.291975), a);
    e = e * t + dot(vec4(-0.557022, 4.938939, -16.451527, 11.802070), a);
    e = e * t + dot(vec4(-0.249129, 4.065364, -5.214557, -4.288852), a);
    e = e * t + dot(vec4(0.302668, -2.146362, 10.870198, -12.223230), a);
    e = e * t + dot(vec4(0.271206, -1.945337, 6.168108, -4.813391), a);
    e = e * t + dot(vec4(0.096204, 0.082657, -0.344948, 0.355349), a);
    e = e * t + dot(vec4(-0.089573, 0.213428, -1.257580, 0.723584), a);
    e = e * t + dot(vec4(0.902549, 0.027905, -0.943584, 0.392163), a);
    return clamp(e, 0, 1);
}

float ggx_fit_fresnel_root(float mu, float t, float roughness) {
    vec4 r = vec4(1, roughness, roughness * roughness, roughness * roughness * roughness);
    float r4 = r.z * r.z;
    float q = 0;
    float row = 0;
    row = (0.691213);
    q = q * mu + row;
    row = (-23.164952);
    row = row * t + dot(vec2(21.901868, -2.335528), r.xy);
    q = q * mu + row;
    row = (14.549542);
    row = row * t + dot(vec2(-119.877043, 15.605636), r.xy);
    row = row * t + dot(vec3(105.880254, -7.033658, -41.860882), r.xyz);
    q = q * mu + row;
    row = (-1.350869);
    row = row * t + dot(vec2(38.055719, 10.289594), r.xy);
    row = row * t + dot(vec2(-152.420023, 35.859499), r.xy);
    row = row * t + dot(vec4(115.691100, -49.917267, -144.997171, 83.327881), r);
    q = q * mu + row;
    row = (-0.513988);
    row = row * t + dot(vec2(2.835357, -5.501507), r.xy);
    row = row * t + dot(vec2(-5.632797, 21.606271), r.xy);
    row = row * t + dot(vec2(3.735889, -21.438922), r.xy);
    row = row * t + dot(vec4(-1.434777, 5.699706, -106.498334, 98.288219), r) + r4 * (-34.153281);
    q = q * mu + row;
    row = (-0.002433);
    row = row * t + dot(vec2(0.007355, -0.147013), r.xy);
    row = row * t + dot(vec2(0.000922, 0.068911), r.xy);
    row = row * t + dot(vec2(-0.005405, 0.105752), r.xy);
    row = row * t + dot(vec2(-0.000915, 0.053389), r.xy);
    row = row * t + dot(vec4(1.001367, -0.083344, -1.880808, 3.753997), r) + r4 * (-3.060591 + (0.975652) * r.y);
    q = q * mu + row;
    return clamp(q, 0, 1);
}

vec3 ggx_fit_averages(float r) {
    vec3 e = vec3(2.213816, 6.566972, 1.304397);
    e = e * r + vec3(-10.569336, -29.439663, -6.403141);
    e = e * r + vec3(20.965501, 52.236027, 13.480258);
    e = e * r + vec3(-22.129886, -47.422139, -15.441092);
    e = e * r + vec3(13.046118, 25.132054, 10.041536);
    e = e * r + vec3(-3.928915, -8.968049, -3.397967);
    e = e * r + vec3(0.377976, 1.395229, 0.401227);
    e = e * r + vec3(-0.019132, -0.092325, -0.023907);
    e = e * r + vec3(0.048443, 1.001951, 0.048578);
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

// Albedo of the compensated lobe, in [0, 1]; terms from ggx_albedo_terms. f90 is the reflectance at grazing incidence, in
// [0, 1], not below f0.
vec3 compensated_albedo(vec3 f0, float f90, vec2 terms) {
    return (f0 + (f90 - f0) * terms.y) * (terms.x + f0 * (1.0 - terms.x));
}

// Its cosine-weighted average; terms from ggx_average_terms.
vec3 average_compensated_albedo(vec3 f0, float f90, vec3 terms) {
    return f0 * (terms.y + f0 * (1.0 - terms.y)) + (f90 - f0) * (terms.x + f0 * (terms.z - terms.x));
}

#endif
