//! host-render
fn main() {}
