//! Every shader is valid WGSL that browsers run: no capability beyond WebGPU's core.

use naga::valid::{Capabilities, ValidationFlags, Validator};

#[test]
fn every_shader_is_portable() {
    for name in trimloop_gpu::shaders::names() {
        let source = trimloop_gpu::shaders::source(name).expect("listed");
        let module = naga::front::wgsl::parse_str(&source)
            .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
        // Browsers guarantee 8 storage buffers per stage and 16 KiB of workgroup memory.
        for (k, entry) in module.entry_points.iter().enumerate() {
            let used = info.get_entry_point(k);
            let storage = module.global_variables.iter().filter(|(handle, variable)| {
                matches!(variable.space, naga::AddressSpace::Storage { .. }) && !used[*handle].is_empty()
            });
            assert!(storage.count() <= 8, "{name}, {}, has too many storage buffers", entry.name);
        }
        let shared = module.global_variables.iter().filter(|(_, v)| v.space == naga::AddressSpace::WorkGroup);
        let mut layouter = naga::proc::Layouter::default();
        layouter.update(module.to_ctx()).expect("sized");
        assert!(shared.map(|(_, v)| layouter[v.ty].size).sum::<u32>() <= 16_384, "{name}");
    }
}

#[test]
fn every_file_is_listed() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders");
    let files = std::fs::read_dir(folder).expect("shaders").filter_map(|entry| {
        let path = entry.ok()?.path();
        (path.extension()? == "wgsl").then(|| path.file_stem().map(|s| s.to_string_lossy().into_owned()))?
    });
    let mut files: Vec<String> = files.collect();
    let mut listed: Vec<String> = trimloop_gpu::shaders::names().map(str::to_owned).collect();
    files.sort();
    listed.sort();
    assert_eq!(files, listed);
}
