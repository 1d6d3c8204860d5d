//! Errors in a line.

/// The error and its causes, each thing said once.
pub fn of(error: &anyhow::Error) -> String {
    let mut texts: Vec<String> = error.chain().map(ToString::to_string).collect();
    // An error that shows its cause's text has said it.
    texts.dedup_by(|cause, error| error.ends_with(cause.as_str()));
    texts.join(": ").replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use std::io;

    use trimloop_gltf::GltfError;

    #[test]
    fn nothing_is_said_twice() {
        let error = anyhow::Error::new(GltfError::Io(io::Error::other("the disk is full")));
        assert_eq!(
            super::of(&error.context("cannot write `a.glb`")),
            "cannot write `a.glb`: the disk is full"
        );
    }
}
