//! Flat triangles without depth, transformed and clipped. For its size: nothing is printed.

#![no_std]
#![no_main]

fixel_riscv::bare_image!(fixel_workloads::sizes::flat);
