//! Textured triangles in perspective with depth, transformed and clipped. By less code, for its size: nothing is printed.

#![no_std]
#![no_main]

fixel_cortex_m::bare_image!(fixel_workloads::sizes::textured_compact);
