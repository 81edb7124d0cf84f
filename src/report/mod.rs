//! Error against run time: sweeps of the knobs that trade one for the other.
