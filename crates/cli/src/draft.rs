//! A file under a temporary name beside its target, renamed into place when it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::{NamedTempFile, TempPath};

use crate::interrupt::{self, Temporary};

/// A file in the making. Dropped before [`publish`], it leaves nothing behind.
pub struct Draft {
    target: PathBuf,
    /// The temporary name; none where the target is no regular file (`/dev/stdout`, a pipe) and is written directly.
    path: Option<(TempPath, Temporary)>,
    out: BufWriter<File>,
}

impl Draft {
    /// Starts the file that will become `target`. An existing `target` stays as it is until [`publish`].
    pub fn beside(target: &Path) -> anyhow::Result<Self> {
        Self::open(target).with_context(|| cannot_write(target))
    }

    fn open(target: &Path) -> io::Result<Self> {
        // A link stays a link: what it points to is replaced.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_path_buf());
        let existing = fs::metadata(&target).ok();
        if existing.as_ref().is_some_and(fs::Metadata::is_dir) {
            return Err(io::Error::other("it is a folder"));
        }
        if existing.as_ref().is_some_and(|m| !m.is_file()) {
            let file = File::options().write(true).open(&target)?;
            return Ok(Self { target, path: None, out: buffered(file) });
        }
        let (file, path) = temporary(&target)?.into_parts();
        if let Some(metadata) = existing {
            file.set_permissions(metadata.permissions())?;
        }
        let temporary = Temporary::new(&path);
        Ok(Self { target, path: Some((path, temporary)), out: buffered(file) })
    }

    /// The file that this will become.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Renames it into place.
    fn persist(self) -> io::Result<()> {
        self.out.into_inner().map_err(io::IntoInnerError::into_error)?;
        match self.path {
            Some((path, _)) => path.persist(&self.target).map_err(|error| error.error),
            None => Ok(()),
        }
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        interrupt::check()?;
        self.out.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Puts all `drafts` in place, in their order; where one cannot be, those before it that replaced nothing are removed
/// again.
pub fn publish(mut drafts: Vec<Draft>) -> anyhow::Result<()> {
    for draft in &mut drafts {
        draft.flush().with_context(|| cannot_write(&draft.target))?;
    }
    let mut added = Vec::new();
    for draft in drafts {
        let target = draft.target.clone();
        let is_new = !target.exists();
        if let Err(error) = draft.persist() {
            for path in added {
                let _ = fs::remove_file(path); // The first error is the one to tell.
            }
            return Err(error).with_context(|| cannot_write(&target));
        }
        if is_new {
            added.push(target);
        }
    }
    Ok(())
}

fn buffered(file: File) -> BufWriter<File> {
    BufWriter::with_capacity(1 << 16, file)
}

fn cannot_write(target: &Path) -> String {
    format!("cannot write `{}`", target.display())
}

/// A temporary file in the folder of `target`, with the permissions that the user's umask gives to new files.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut prefix = std::ffi::OsString::from(".");
    prefix.push(target.file_name().unwrap_or_default());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // Without the name of the temporary file, which would only confuse.
    builder.tempfile_in(folder).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => io::Error::other("its folder does not exist"),
        kind => io::Error::from(kind),
    })
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::Write;

    use super::{Draft, publish};

    #[test]
    fn the_target_appears_only_when_published() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("out.glb");
        let mut draft = Draft::beside(&target).expect("a draft");
        draft.write_all(b"glTF").expect("written");
        assert!(!target.exists());
        publish(vec![draft]).expect("published");
        assert_eq!(fs::read(&target).expect("a file"), b"glTF");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }

    #[test]
    fn a_dropped_draft_leaves_nothing_and_touches_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("out.glb");
        fs::write(&target, "old").expect("written");
        let mut draft = Draft::beside(&target).expect("a draft");
        draft.write_all(b"half").expect("written");
        drop(draft);
        assert_eq!(fs::read(&target).expect("a file"), b"old");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }

    #[test]
    fn what_was_published_before_a_failure_is_taken_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let (first, second) = (folder.path().join("a.bin"), folder.path().join("a.gltf"));
        let drafts = vec![Draft::beside(&first).expect("a draft"), Draft::beside(&second).expect("a draft")];
        fs::create_dir(&second).expect("a folder in the way");
        assert!(publish(drafts).is_err());
        assert!(!first.exists());
    }

    #[cfg(unix)]
    #[test]
    fn new_files_have_the_permissions_of_new_files_and_replaced_ones_keep_theirs() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let mode = |path: &std::path::Path| fs::metadata(path).expect("a file").permissions().mode() & 0o777;
        let (plain, target) = (folder.path().join("plain"), folder.path().join("out.glb"));
        fs::write(&plain, "").expect("written");
        publish(vec![Draft::beside(&target).expect("a draft")]).expect("published");
        assert_eq!(mode(&target), mode(&plain));
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("set");
        publish(vec![Draft::beside(&target).expect("a draft")]).expect("published");
        assert_eq!(mode(&target), 0o640);
    }
}
