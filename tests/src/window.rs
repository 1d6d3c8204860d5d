//! A program's window on a display of its own (Xvfb), driven and photographed as a person would.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, bail, ensure};
use trimloop_render::Picture;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{self, ConnectionExt as _, ImageFormat, InputFocus};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// A window and the program behind it; both end with it.
pub struct Window {
    display: Killed,
    program: Killed,
    connection: RustConnection,
    root: xproto::Window,
    size: [u16; 2],
    /// Settings of its own, so that nobody's are read or written.
    _home: tempfile::TempDir,
}

/// A process that ends with its owner.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// What is held down while a key or a button is pressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum With {
    /// Nothing.
    #[default]
    Nothing,
    /// Shift.
    Shift,
    /// Control.
    Control,
}

/// Keys by their keysyms (`keysymdef.h`); letters and digits are their own.
pub mod key {
    /// Escape.
    pub const ESCAPE: u32 = 0xff1b;
    /// Return.
    pub const RETURN: u32 = 0xff0d;
    /// F5.
    pub const F5: u32 = 0xffc2;
    pub(super) const SHIFT: u32 = 0xffe1;
    pub(super) const CONTROL: u32 = 0xffe3;
}

/// A picture that stays the same for so long is the one that was waited for.
const REST: Duration = Duration::from_millis(900);
const START_REST: Duration = Duration::from_millis(2500);
/// Longer nothing is waited for.
const PATIENCE: Duration = Duration::from_secs(60);
/// The program is given so much time between what is done to it.
const STEP: Duration = Duration::from_millis(60);

/// Whether there is a display server to open windows on.
pub fn is_possible() -> bool {
    let run = Command::new("Xvfb").arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status();
    run.is_ok()
}

impl Window {
    /// Starts `program` on a display of `size` pixels and waits for its window.
    ///
    /// # Errors
    /// Where there is no Xvfb, or no window comes.
    pub fn open<S: AsRef<OsStr>>(
        program: &Path,
        arguments: impl IntoIterator<Item = S>,
        size: [u16; 2],
    ) -> anyhow::Result<Self> {
        let screen = format!("{}x{}x24", size[0], size[1]);
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &screen])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .context("Xvfb is needed to open windows")?;
        let told = server.stdout.take().context("Xvfb says nothing")?;
        let display = Killed(server);
        let mut number = String::new();
        BufReader::new(told).read_line(&mut number)?;
        let name = format!(":{}", number.trim());
        let (connection, screen) = x11rb::connect(Some(&name))?;
        let root = connection.setup().roots[screen].root;
        let home = tempfile::tempdir()?;
        let child = Command::new(program)
            .args(arguments)
            .env("DISPLAY", &name)
            .env("XDG_DATA_HOME", home.path())
            .env("XDG_CONFIG_HOME", home.path())
            .env("XDG_RUNTIME_DIR", home.path())
            .env_remove("WAYLAND_DISPLAY")
            // Dialogs of the system would wait for somebody.
            .env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent")
            .env("PATH", "/nonexistent")
            .spawn()
            .with_context(|| format!("cannot start {}", program.display()))?;
        let mut own = Self { display, program: Killed(child), connection, root, size, _home: home };
        own.await_window()?;
        Ok(own)
    }

    /// Waits for the window and gives it the keyboard: there is no window manager that would.
    ///
    /// # Errors
    /// Where the program ends first, or nothing comes.
    pub fn await_window(&mut self) -> anyhow::Result<()> {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            ensure!(self.display.0.try_wait()?.is_none(), "the display is gone");
            if let Some(status) = self.program.0.try_wait()? {
                bail!("the program ended: {status}");
            }
            for window in self.connection.query_tree(self.root)?.reply()?.children {
                let attributes = self.connection.get_window_attributes(window)?.reply()?;
                let area = self.connection.get_geometry(window)?.reply()?;
                if attributes.map_state == xproto::MapState::VIEWABLE && area.width > 100 {
                    self.connection
                        .set_input_focus(InputFocus::PARENT, window, x11rb::CURRENT_TIME)?
                        .check()?;
                    return Ok(());
                }
            }
            std::thread::sleep(STEP);
        }
        bail!("no window comes")
    }

    /// Whether the program still runs.
    pub fn is_alive(&mut self) -> bool {
        matches!(self.program.0.try_wait(), Ok(None))
    }

    /// Its process.
    pub fn process(&self) -> u32 {
        self.program.0.id()
    }

    /// What the display shows.
    ///
    /// # Errors
    /// Where the display is gone.
    pub fn photograph(&self) -> anyhow::Result<Picture> {
        let [width, height] = self.size;
        let image = self
            .connection
            .get_image(ImageFormat::Z_PIXMAP, self.root, 0, 0, width, height, u32::MAX)?
            .reply()?;
        // Blue, green, red and nothing.
        let rgba = image.data.chunks_exact(4).flat_map(|p| [p[2], p[1], p[0], 255]).collect();
        Ok(Picture { width: width.into(), height: height.into(), rgba })
    }

    /// What the display shows when nothing changes any more.
    ///
    /// # Errors
    /// Where that does not happen.
    pub fn settled(&self) -> anyhow::Result<Picture> {
        self.at_rest_for(REST)
    }

    /// The same where much has to be made first, such as the device's programs at the start.
    ///
    /// # Errors
    /// Where that does not happen.
    pub fn started(&self) -> anyhow::Result<Picture> {
        self.at_rest_for(START_REST)
    }

    fn at_rest_for(&self, rest: Duration) -> anyhow::Result<Picture> {
        let start = Instant::now();
        let mut last = self.photograph()?;
        let mut since = Instant::now();
        while start.elapsed() < PATIENCE {
            std::thread::sleep(STEP);
            let own = self.photograph()?;
            if own != last {
                (last, since) = (own, Instant::now());
            } else if since.elapsed() > rest && !is_blank(&last) {
                return Ok(last);
            }
        }
        bail!("the window does not come to rest")
    }

    fn fake(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) -> anyhow::Result<()> {
        self.connection.xtest_fake_input(kind, detail, 0, self.root, x, y, 0)?.check()?;
        Ok(())
    }

    /// The code of the key that a keysym stands on.
    fn code(&self, keysym: u32) -> anyhow::Result<u8> {
        let setup = self.connection.setup();
        let count = setup.max_keycode - setup.min_keycode + 1;
        let map = self.connection.get_keyboard_mapping(setup.min_keycode, count)?.reply()?;
        let per_key = usize::from(map.keysyms_per_keycode).max(1);
        let place = map.keysyms.chunks(per_key).position(|own| own.contains(&keysym));
        place.map(|k| setup.min_keycode + k as u8).with_context(|| format!("no key for {keysym:#x}"))
    }

    fn holding(&self, with: With, work: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
        let held = match with {
            With::Nothing => None,
            With::Shift => Some(self.code(key::SHIFT)?),
            With::Control => Some(self.code(key::CONTROL)?),
        };
        if let Some(code) = held {
            self.fake(xproto::KEY_PRESS_EVENT, code, [0; 2])?;
            std::thread::sleep(STEP);
        }
        work()?;
        std::thread::sleep(STEP);
        if let Some(code) = held {
            self.fake(xproto::KEY_RELEASE_EVENT, code, [0; 2])?;
        }
        std::thread::sleep(STEP);
        Ok(())
    }

    /// Presses a key.
    ///
    /// # Errors
    /// Where there is no such key.
    pub fn press(&self, keysym: impl Into<u32>, with: With) -> anyhow::Result<()> {
        let code = self.code(keysym.into())?;
        self.holding(with, || {
            self.fake(xproto::KEY_PRESS_EVENT, code, [0; 2])?;
            std::thread::sleep(STEP);
            self.fake(xproto::KEY_RELEASE_EVENT, code, [0; 2])
        })
    }

    /// Moves the mouse.
    ///
    /// # Errors
    /// Where the display is gone.
    pub fn move_to(&self, at: [i16; 2]) -> anyhow::Result<()> {
        self.fake(xproto::MOTION_NOTIFY_EVENT, 0, at)?;
        std::thread::sleep(STEP);
        Ok(())
    }

    /// Clicks with the left button.
    ///
    /// # Errors
    /// Where the display is gone.
    pub fn click(&self, at: [i16; 2], with: With) -> anyhow::Result<()> {
        self.move_to(at)?;
        self.holding(with, || {
            self.fake(xproto::BUTTON_PRESS_EVENT, 1, at)?;
            std::thread::sleep(STEP);
            self.fake(xproto::BUTTON_RELEASE_EVENT, 1, at)
        })
    }

    /// Drags with a button (1 left, 2 middle, 3 right).
    ///
    /// # Errors
    /// Where the display is gone.
    pub fn drag(&self, button: u8, from: [i16; 2], to: [i16; 2]) -> anyhow::Result<()> {
        self.move_to(from)?;
        self.fake(xproto::BUTTON_PRESS_EVENT, button, from)?;
        let steps = 8;
        for k in 1..=steps {
            let at = [0, 1].map(|d| from[d] + (to[d] - from[d]) * k / steps);
            self.move_to(at)?;
        }
        self.fake(xproto::BUTTON_RELEASE_EVENT, button, to)?;
        std::thread::sleep(STEP);
        Ok(())
    }

    /// Turns the wheel: forwards where `notches` is positive.
    ///
    /// # Errors
    /// Where the display is gone.
    pub fn scroll(&self, at: [i16; 2], notches: i32) -> anyhow::Result<()> {
        self.move_to(at)?;
        let button = if notches > 0 { 4 } else { 5 };
        for _ in 0..notches.unsigned_abs() {
            self.fake(xproto::BUTTON_PRESS_EVENT, button, at)?;
            self.fake(xproto::BUTTON_RELEASE_EVENT, button, at)?;
            std::thread::sleep(STEP);
        }
        Ok(())
    }
}

/// Whether there is nothing to see yet.
fn is_blank(picture: &Picture) -> bool {
    let mut pixels = picture.rgba.chunks_exact(4);
    let first = pixels.next();
    pixels.all(|own| Some(own) == first)
}
