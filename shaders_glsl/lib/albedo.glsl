// Directional albedo of isotropic GGX (alpha = roughness^2 >= 1e-3, height-correlated Smith, Schlick with F90 = 1), and
// the terms that couple lobes by it. Functions only.
//
// Sources: Turquin 2019, "Practical multiple scattering compensation for microfacet models"; Kelemen & Szirmay-Kalos
// 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model". The polynomials are our own: minimax fits made by
// tools/fit_albedo.rs, which prints the text between the marks. Against quadrature over roughness 0..1, mu 1e-4..1:
// scale and bias within 0.0025, their sum within 0.8 % and never more than 0.1 % below the truth, as that would gain
// energy.
#ifndef VAIR_ALBEDO_GLSL
#define VAIR_ALBEDO_GLSL

// fit: begin
float ggx_fit_white(float t, float alpha) {
    vec4 a = vec4(1, alpha, alpha * alpha, alpha * alpha * alpha);
    float e = dot(vec4(0.290342, -2.594598, 2.290154, 2.750479), a);
    e = e * t + dot(vec4(0.077212, -2.716184, -1.451764, 8.071715), a);
    e = e * t + dot(vec4(-0.620482, 4.324464, -13.651771, 8.104055), a);
    e = e * t + dot(vec4(-0.263194, 4.696628, -7.505366, -2.786634), a);
    e = e * t + dot(vec4(0.341526, -1.743941, 9.267131, -11.014753), a);
    e = e * t + dot(vec4(0.275498, -2.200253, 7.336417, -5.851229), a);
    e = e * t + dot(vec4(0.089214, -0.007802, 0.077217, -0.000509), a);
    e = e * t + dot(vec4(-0.089546, 0.224128, -1.320690, 0.783948), a);
    e = e * t + dot(vec4(0.902607, 0.029147, -0.948111, 0.395561), a);
    return clamp(e, 0, 1);
}

float ggx_fit_fresnel_root(float mu, float t, float roughness) {
    vec4 r = vec4(1, roughness, roughness * roughness, roughness * roughness * roughness);
    float r4 = r.z * r.z;
    float q = 0;
    float row = 0;
    row = (0.063546);
    q = q * mu + row;
    row = (3.553992);
    row = row * t + dot(vec2(-3.808783, 0.765872), r.xy);
    q = q * mu + row;
    row = (-7.784471);
    row = row * t + dot(vec2(-1164102290087.057373, -8.407507), r.xy);
    row = row * t + dot(vec3(1164102290095.031006, 10.732907, -5.966021), r.xyz);
    q = q * mu + row;
    row = (-1.939510);
    row = row * t + dot(vec2(271164421112.914368, -8.409279), r.xy);
    row = row * t + dot(vec3(-158521403014.705566, 844227791250.545776, -814871603071.281494), r.xyz);
    row = row * t + dot(vec4(-112643018096.256973, -844227791244.918213, -814871603066.740845, 9.390740), r);
    q = q * mu + row;
    row = (-0.603935);
    row = row * t + dot(vec2(-419470678082.688049, -6.067794), r.xy);
    row = row * t + dot(vec3(-124543809869.187836, -374032198552.383728, 189815094750.058105), r.xyz);
    row = row * t + dot(vec4(451714789393.904297, 395541537383.700806, -88626741319.001068, 590959453831.341309), r);
    row = row * t + dot(vec4(92299698557.565796, -21509338824.885544, 436142061460.254883, 590959453883.215698), r) + r4 * (-14.974789);
    q = q * mu + row;
    row = (-0.005260);
    row = row * t + dot(vec2(0.008552, -0.159609), r.xy);
    row = row * t + dot(vec3(0.003272, 0.081582, -293629474659.936218), r.xyz);
    row = row * t + dot(vec4(-0.005985, 0.111687, -674439616224.540283, -261822539000.129730), r);
    row = row * t + dot(vec4(-0.001274, 0.052686, -445419930555.846741, -246766001820.955811), r) + r4 * (-250104364159.361084);
    row = row * t + dot(vec4(1.001577, -0.094549, -64609788992.910591, 15056537182.307039), r) + r4 * (-250104364161.662933 + (0.652382) * r.y);
    q = q * mu + row;
    return clamp(q, 0, 1);
}

vec3 ggx_fit_averages(float r) {
    vec3 e = vec3(2.867406, 6.126361, 0.844303);
    e = e * r + vec3(-13.546336, -25.968773, -5.131885);
    e = e * r + vec3(26.821402, 43.333681, 12.610810);
    e = e * r + vec3(-28.602839, -36.583464, -16.242404);
    e = e * r + vec3(17.328914, 18.128400, 11.606685);
    e = e * r + vec3(-5.570635, -6.536655, -4.307458);
    e = e * r + vec3(0.700879, 0.970451, 0.620242);
    e = e * r + vec3(-0.044219, -0.061301, -0.042215);
    e = e * r + vec3(0.049028, 1.001247, 0.049023);
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
