//! Every shader function against its double-precision twin, on the device.
