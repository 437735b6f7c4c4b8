//! On macOS the linker has to be told that Python gives the symbols of its library.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
