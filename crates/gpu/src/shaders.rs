//! The shaders: one file per pass in `shaders/`, put together here with what they share.

/// A pass' source, as WGSL reads it.
pub fn source(name: &str) -> Option<String> {
    let (_, parts) = SHADERS.iter().find(|(own, _)| *own == name)?;
    Some(parts.concat())
}

/// The names of all passes.
pub fn names() -> impl Iterator<Item = &'static str> {
    SHADERS.iter().map(|(name, _)| *name)
}

macro_rules! shader {
    ($name:literal $(, $shared:literal)*) => {
        ($name, &[
            $(include_str!(concat!("../../../shaders/shared/", $shared, ".wgsl")),)*
            include_str!(concat!("../../../shaders/", $name, ".wgsl")),
        ])
    };
}

const SHADERS: &[(&str, &[&str])] = &[
    shader!("bezier_basis", "line"),
    shader!("bezier_grid", "line", "job", "basis", "finish", "write"),
    shader!("krishnamurthy_unpacked", "line", "krishnamurthy"),
    shader!("krishnamurthy_packed", "line", "krishnamurthy"),
    shader!("krishnamurthy_indexed", "line", "krishnamurthy"),
    shader!("tensor_points", "line", "job", "basis", "finish", "write"),
    shader!("trim_classify", "trim"),
    shader!("trim_fan"),
    shader!("trim_pack"),
    shader!("cubic_curve"),
    shader!("bicubic_patch", "line", "job", "finish"),
    shader!("lod_factors"),
    shader!("haar_down", "wavelet"),
    shader!("haar_up", "wavelet"),
    shader!("lifting_down", "wavelet"),
    shader!("lifting_up", "wavelet"),
    shader!("tan_rows", "line", "job", "de_boor"),
    shader!("tan_columns", "line", "job", "de_boor", "finish", "write"),
    shader!("surface", "trim", "frame", "shade"),
    shader!("border", "frame", "shade", "segment"),
    shader!("edge", "frame", "segment"),
    shader!("compose"),
    shader!("emit"),
];
