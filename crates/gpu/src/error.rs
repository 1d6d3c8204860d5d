//! What can go wrong on the way to the GPU and back.

/// Why a request could not be carried out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// Neither a GPU nor a software renderer was found.
    #[error(
        "no graphics adapter was found ({0}). Install a Vulkan driver for the GPU, or a software one: on Debian and \
         Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter(String),
    /// The adapter gives no device with the limits that every browser has.
    #[error("{adapter} could not be opened: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What the driver says.
        reason: String,
    },
    /// The device went away: taken out, reset, driver restarted.
    #[error("the graphics device was lost during `{request}`: {reason}")]
    Lost {
        /// What was being done.
        request: String,
        /// What the driver says.
        reason: String,
    },
    /// The device's memory did not suffice.
    #[error("the graphics device has not enough memory for `{request}`")]
    OutOfMemory {
        /// What was being done.
        request: String,
    },
    /// A request that no adapter of this kind can carry out, however it is cut up.
    #[error("`{request}` is more than the graphics device can take: {reason}")]
    TooLarge {
        /// What was being done.
        request: String,
        /// Which limit is in the way.
        reason: String,
    },
    /// A fault of this crate or of the driver.
    #[error("the graphics device refused `{request}`: {reason}")]
    Refused {
        /// What was being done.
        request: String,
        /// What the validation says.
        reason: String,
    },
    /// A request that makes no sense.
    #[error("{0}")]
    Request(String),
}
