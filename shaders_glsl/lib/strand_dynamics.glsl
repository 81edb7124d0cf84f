// How the tip of a strand lags behind its moving root: the exact step of a damped oscillator.
//
// x'' + 2 zeta w x' + w^2 (x - u) = 0 for the tip x and the root u, which moves evenly over a step ("linear hold").
// The state is the lag d = x - u and the velocity v = x'; d' = v - s and v' = -2 zeta w v - w^2 d, s the root's velocity.
// Being exact, a step is stable for every stiffness, damping and length of time.
#ifndef VAIR_STRAND_DYNAMICS_GLSL
#define VAIR_STRAND_DYNAMICS_GLSL

// A root that was out of sight for longer has stopped and started again for all that is known.
const float STRAND_LONGEST_STEP_S = 0.1;

struct StrandState {
    vec3 lag;      // of the tip behind the place where it rests, metres, world space
    vec3 velocity; // of the tip, metres a second, world space
};

const StrandState STRAND_AT_REST = StrandState(vec3(0.0), vec3(0.0));

// (1 - exp(-x)) / x for x >= 0, which is expm1(-x) / -x and the mean of exp over [-x, 0]. Below 1 its Taylor series: the
// first term left out is x^10 / 11! < 2.6e-8; above it the difference loses less than one bit.
float sway_decay_mean(float x) {
    if (x > 1.0) { return (1.0 - exp(-x)) / x; }
    float sum = 1.0;
    for (float n = 10.0; n >= 2.0; n -= 1.0) { sum = 1.0 - x / n * sum; }
    return sum;
}

// tan for |x| <= pi / 4, since Vulkan promises sin and cos no better than 2^-11: Taylor series, whose first terms left out
// are x^11 / 11! and x^12 / 12! < 2e-9.
float sway_tangent(float x) {
    float s = x * x;
    float sine = x * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))));
    float cosine = 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0))));
    return sine / cosine;
}

// zeta < 1. Around where it would trail for ever, 2 zeta s / w behind the root, the state turns and shrinks by
// exp(-a t), a = zeta w. The turn by W t, W^2 = w^2 - a^2, is three shears: whatever their coefficients are rounded to,
// their determinant is 1, and without damping no energy comes or goes. Half turns are taken off first, so that no shear
// is steep, and no quotient by W is 0 / 0 as the damping becomes critical.
StrandState sway_under_damped(StrandState state, vec3 root_velocity, float dt, float w, float zeta) {
    float a = zeta * w;
    float turn_rate = w * sqrt((1.0 - zeta) * (1.0 + zeta));
    float angle = turn_rate * dt;
    float half_turns = floor(angle / 3.14159265 + 0.5);
    // pi in two parts, of which the first has 8 bits: the product is exact up to 2^16 half turns.
    float left = (angle - half_turns * 3.140625) - half_turns * 9.67653590e-4;
    float tangent = sway_tangent(0.5 * left);
    float sine_over_rate = 2.0 * (tangent / turn_rate) / (1.0 + tangent * tangent);

    vec3 trail = -2.0 * zeta / w * root_velocity;
    vec3 lag = state.lag - trail;
    vec3 velocity = state.velocity - root_velocity;
    lag += (turn_rate * tangent + a) / (w * w) * velocity;
    velocity -= w * w * sine_over_rate * lag;
    lag += (turn_rate * tangent - a) / (w * w) * velocity;
    float scale = exp(-a * dt) * ((int(half_turns) & 1) == 1 ? -1.0 : 1.0);
    return StrandState(trail + scale * lag, root_velocity + scale * velocity);
}

// zeta >= 1. Two first-order lags in a row, with the rates `fast` and `slow` of which w^2 is the product:
// y' = -fast y - slow s for y = v + slow d, and d' = y - slow d - s. Nothing cancels however far apart they are.
StrandState sway_over_damped(StrandState state, vec3 root_velocity, float dt, float w, float zeta) {
    float half_gap = w * sqrt((zeta - 1.0) * (zeta + 1.0));
    float fast = zeta * w + half_gap;
    float slow = w * w / fast;
    float slow_integral = dt * sway_decay_mean(slow * dt);
    float both_integral = exp(-slow * dt) * dt * sway_decay_mean(2.0 * half_gap * dt);

    vec3 y = state.velocity + slow * state.lag;
    float trail = slow_integral + slow / fast * (slow_integral - both_integral);
    // As a change of the old lag, so that a strand that trails steadily does not gather the rounding of many small steps.
    vec3 lag = state.lag + (both_integral * y - slow * slow_integral * state.lag - trail * root_velocity);
    y = exp(-fast * dt) * y - slow * dt * sway_decay_mean(fast * dt) * root_velocity;
    return StrandState(lag, y - slow * lag);
}

bool sway_is_finite(vec3 v) {
    // By the bits: a compiler may take it that floats are finite.
    return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)));
}

// One step of `dt` seconds in which the root moves by `moved` metres; `stiffness` is w^2 in 1/s^2, `damping` the ratio
// zeta. A state that is no number, or a step out of (0, STRAND_LONGEST_STEP_S], comes to rest.
StrandState sway_step(StrandState state, vec3 moved, float dt, float stiffness, float damping) {
    if (!(dt > 0.0 && dt <= STRAND_LONGEST_STEP_S)) { return STRAND_AT_REST; }
    vec3 root_velocity = moved / dt;
    float w = sqrt(stiffness);
    StrandState next;
    if (damping < 1.0) {
        next = sway_under_damped(state, root_velocity, dt, w, damping);
    } else {
        next = sway_over_damped(state, root_velocity, dt, w, damping);
    }
    return sway_is_finite(next.lag) && sway_is_finite(next.velocity) ? next : STRAND_AT_REST;
}

// A strand reaches only so far: a tip beyond `reach` metres is brought back, and what drives it farther away from its root
// is taken from its velocity.
StrandState sway_limited(StrandState state, vec3 root_velocity, float reach) {
    float distance_m = length(state.lag);
    if (!(distance_m > reach)) { return state; }
    vec3 outward = state.lag / distance_m;
    float leaving = max(dot(state.velocity - root_velocity, outward), 0.0);
    return StrandState(reach * outward, state.velocity - leaving * outward);
}

#endif
