//! Where the time, the fragments and the memory of a frame go.
