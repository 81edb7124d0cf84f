// Interference in a thin film on a smooth base, seen from air. Functions only.
//
// Sources: Belcour & Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence"
// (orders of interference, each summed over the spectrum at once); Born & Wolf 1999, "Principles of Optics", 7.6
// (reflectance of a plate). Both polarisations are followed. No film is a limit that needs no branch: the orders then
// add up to the reflectance of the base alone.
//
// Against 801 wavelengths, for 20 000 films of 0 to 1200 nm, film_ior 1 to 2.5, base_f0 0 to 1 and all cosines: mean error
// 0.0015, largest 0.015. Three orders and no tail reach 0.0024 and 0.13.
#ifndef VAIR_FILM_GLSL
#define VAIR_FILM_GLSL
#include "ggx.glsl"

// What the channels answer to cos(2 pi path / wavelength), white giving 1: four bands of Gaussian shape in the
// wavenumber, fitted by tools/fit_film.rs, which prints the text between the marks. A channel's weights add up to 1.
// fit: begin
const vec4 FILM_WAVENUMBER = vec4(1.63831, 1.74877, 1.81771, 2.21685); // 1 / um
const vec4 FILM_WIDTH = vec4(0.07274, 0.09678, 0.13324, 0.11109);      // standard deviation, 1 / um
const vec4 FILM_RED = vec4(1.37358, 1.12989, -1.59018, 0.08671);
const vec4 FILM_GREEN = vec4(-0.33993, -0.02567, 1.49361, -0.12801);
const vec4 FILM_BLUE = vec4(0.01907, -0.06988, -0.09159, 1.14240);
// fit: end

// The bands' answers to a difference of path, of which all orders are made.
struct FilmWaves {
    vec4 half_sine_squared; // sin^2 of half the phase
    vec4 decay;             // amplitude of the first order; that of order m is decay^(m^2)
};

FilmWaves film_waves(float path_um) {
    FilmWaves waves;
    // Whole turns go first: a device owes precision for the angles of one turn alone.
    vec4 turns = FILM_WAVENUMBER * path_um;
    vec4 half_sine = sin(3.141592654 * (turns - floor(turns + 0.5)));
    waves.half_sine_squared = half_sine * half_sine;
    vec4 spread = FILM_WIDTH * (6.283185307 * path_um);
    vec4 exponent = 0.5 * spread * spread;
    // A device's exp may miss 1 by a bit or two at 0, where the sum over all orders is most sensitive.
    waves.decay = mix(exp(-exponent), 1.0 - exponent, lessThan(exponent, vec4(1e-4)));
    return waves;
}

// Sum over all orders m >= 1 of product^m decay^(m^2) cos(m phase), where product, of the amplitudes of the film's two
// faces seen from inside, is sign (1 - apart): apart in (0, 1] keeps its digits where light can hardly leave the film.
// The first two orders are exact; from there on each is taken to be product decay^7 e^(i phase) times the one before,
// which closes the sum. The true ratio is decay^5 and falls with every order; of the constants, decay^7 errs least.
vec4 film_orders(float sign_of_product, float apart, FilmWaves waves) {
    float size = 1.0 - apart;
    // sin^2 of half the angle between product e^(i phase) and 1.
    vec4 gap = sign_of_product < 0.0 ? 1.0 - waves.half_sine_squared : waves.half_sine_squared;
    vec4 decay2 = waves.decay * waves.decay;
    vec4 decay4 = decay2 * decay2;
    vec4 decay7 = decay4 * decay2 * waves.decay;
    vec4 ratio = size * decay7;
    vec4 left = apart + size * (1.0 - decay7);
    // Re(z^2 (1 - ratio conj z)) / |1 - ratio z|^2 for a unit z, in the form that does not cancel near 1.
    vec4 tail = (left + 2.0 * gap * (ratio - 4.0 + 4.0 * gap)) / max(left * left + 4.0 * ratio * gap, 1e-20);
    return size * (waves.decay * (1.0 - 2.0 * gap) + size * decay4 * tail);
}

// Reflectance of the coated base for one polarisation. Fresnel's amplitude at a face is (a - b) / (a + b): outside and
// film are a and b at the outer face, film_inside and base at the inner one.
vec3 film_polarised(float outside, float film, vec3 film_inside, vec3 base, FilmWaves waves) {
    float outer_sum = 1.0 / (outside + film);
    float outer = (outside - film) * outer_sum;
    float passed = 4.0 * outside * film * outer_sum * outer_sum; // 1 - outer^2
    vec3 inner_sum = 1.0 / (film_inside + base);
    vec3 inner = (film_inside - base) * inner_sum;
    vec3 taken = 4.0 * film_inside * base * inner_sum * inner_sum; // 1 - inner^2
    vec3 closed = max(passed + outer * outer * taken, 1e-20); // 1 - (outer inner)^2
    vec3 product = -outer * inner;
    vec3 apart = min(closed / (1.0 + abs(product)), 1.0);
    vec3 orders = vec3(dot(FILM_RED, film_orders(product.x, apart.x, waves)),
                       dot(FILM_GREEN, film_orders(product.y, apart.y, waves)),
                       dot(FILM_BLUE, film_orders(product.z, apart.z, waves)));
    return outer * outer + passed * (passed * inner * inner - 2.0 * taken * orders) / closed;
}

// Share of white light that comes back per channel, in [0, 1]. cosine to the normal in [0, 1]; thickness_nm >= 0;
// film_ior > 0, relative to air; base_f0 = reflectance of the bare base at normal incidence, which stands for a real
// index per channel. Total reflection, at films below the index of air, returns 1.
vec3 film_reflectance(float cosine, float thickness_nm, float film_ior, vec3 base_f0) {
    // Nearer to the horizon everything is reflected, and rounding would show.
    cosine = max(cosine, 1e-4);
    // Index times cosine: along the normal, in units of the wave number in air.
    float film_squared = (film_ior - 1.0) * (film_ior + 1.0) + cosine * cosine;
    if (film_squared <= 0.0) {
        return vec3(1.0);
    }
    float film = sqrt(film_squared);
    // The base's index is (1 + root) / (1 - root); times (1 - root), all stays finite for a perfect mirror.
    vec3 root = sqrt(base_f0);
    vec3 rest = 1.0 - root;
    vec3 base = sqrt(4.0 * root + rest * rest * (cosine * cosine));
    float film_ior2 = film_ior * film_ior;
    FilmWaves waves = film_waves(2e-3 * film * thickness_nm);
    vec3 s = film_polarised(cosine, film, rest * film, base, waves);
    vec3 p = film_polarised(film_ior2 * cosine, film, (1.0 + root) * (1.0 + root) * film, film_ior2 * rest * base, waves);
    return clamp(0.5 * (s + p), 0.0, 1.0);
}

// F0 of the Schlick curve that has that reflectance at that cosine, in [0, 1]: what lobes take that know Schlick alone.
vec3 film_f0(vec3 reflectance, float cosine) {
    float weight = schlick_weight(cosine);
    return clamp((reflectance - weight) / max(1.0 - weight, 1e-5), 0.0, 1.0);
}

#endif
