//! The limit that shells approach: coats ray-cast in double precision on the CPU, from the formulas, sharing no code with
//! the shaders.
