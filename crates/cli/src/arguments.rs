//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use trimloop_compare::{Gates, Reach};
use trimloop_gltf::{GltfOptions, UpAxis};
use trimloop_mesh::{LinearDeflection, MeshOptions};
use trimloop_render::{Background, Direction, Lod, Section};

use crate::quantity;

/// Converts STEP and IGES files to glTF: watertight, coloured, named, with the truth about every face.
#[derive(Debug, Parser)]
#[command(name = "trimloop", version, max_term_width = 100)]
#[command(
    after_help = "Exit codes: 0 all well; 1 written, but a face was lost or part of the file is damaged (or a face only \
approximated, with --strict); 2 nothing usable.\n`trimloop COMMAND --help` explains a command."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Convert STEP and IGES files to glTF (.glb or .gltf)
    #[command(after_help = CONVERT_EXAMPLES)]
    Convert(ConvertArguments),
    /// Show what is in STEP and IGES files: assembly tree, units, bodies, surfaces, colours
    #[command(after_help = INSPECT_EXAMPLES)]
    Inspect(InspectArguments),
    /// Draw STEP and IGES files: exact surfaces, evaluated on the GPU for the picture
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArguments),
    /// Open STEP and IGES files in a window
    #[command(after_help = VIEW_EXAMPLES)]
    View(ViewArguments),
    /// Compare two shapes, CAD files or meshes: distances both ways, area, volume, topology, and a verdict
    #[command(after_help = COMPARE_EXAMPLES)]
    Compare(CompareArguments),
    /// Run a suite of comparisons: a folder, or a TOML file of cases
    #[command(after_help = REGRESS_EXAMPLES)]
    Regress(RegressArguments),
    /// Print a completion script for a shell
    Completions {
        /// The shell to complete for
        shell: Shell,
    },
    /// Print the manual page, or write all pages to a folder
    Man {
        /// Folder for trimloop.1, trimloop-convert.1, ... [default: print trimloop.1]
        #[arg(value_name = "FOLDER")]
        folder: Option<PathBuf>,
    },
}

const CONVERT_EXAMPLES: &str = "\
Examples:
  trimloop convert bracket.step                          writes bracket.glb beside it
  trimloop convert bracket.step -o web/bracket.gltf      writes bracket.gltf and bracket.bin
  trimloop convert *.stp -o glb/ --report glb/           one .glb and one .json report each
  trimloop convert gear.step --linear-deflection 0.02mm --angular-deflection 5deg
  trimloop convert gear.step --strict --report -         report on standard output

Exit codes:
  0  all well
  1  written, but a face was lost or part of the file is damaged (with --strict also: a face only approximated)
  2  nothing usable: bad usage, unreadable file, unwritable output; nothing is left behind
  130  stopped (Ctrl-C)
With several inputs, the worst of them.";

const RENDER_EXAMPLES: &str = "\
Examples:
  trimloop render bracket.step                                writes bracket.png beside it
  trimloop render gearbox.step -o front.png --view front --ortho --size 2400x1600
  trimloop render gearbox.step -o cut.png --section x=10mm --hide Cover
  trimloop render gearbox.step -o turn/gearbox.png --turntable 36 --transparent
  trimloop render parts/*.step -o sheet.png                   one picture of all, a contact sheet
  trimloop render parts/*.step -o thumbs/ --size 128x128 --edges none
  trimloop render bracket.step --pick 640,480                 what is there: face, exact point, normal, radius

Without a GPU, software Vulkan is used (Debian: mesa-vulkan-drivers), and without that a picture of triangles is drawn.

Exit codes:
  0  all well
  1  drawn, but a face was lost or part of the file is damaged
  2  nothing usable: bad usage, unreadable file, unwritable output; nothing is left behind
  130  stopped (Ctrl-C)
With several inputs, the worst of them.";

const VIEW_EXAMPLES: &str = "\
Examples:
  trimloop view bracket.step              files can also be dropped into the window
  trimloop view *.step --up y

`?` lists the keys. A file that changes on disk is read again, and the view stays.

Exit codes:
  0  the window was closed
  2  no window could be opened";

const COMPARE_EXAMPLES: &str = "\
Examples:
  trimloop compare bracket.step bracket.stl                     is the mesh what the model says?
  trimloop compare new.step old.step --max-distance 0.05mm      has the model changed, and where?
  trimloop compare part.step part.glb --html part.html          with pictures
  trimloop compare part.step part.obj --unit in --up y          where the guess is wrong
  trimloop compare a.stl b.stl --report - | jq .comparison.a_to_b

CAD files (STEP, IGES) count as their exact surfaces; meshes are STL, OBJ, PLY, glTF and 3MF. Where both meet, the
distance of the mesh's corners is to the exact surface, and area and volume are integrals over it.

Verdicts:
  same               within the gates
  different          outside
  reference suspect  outside, but all that speaks for it is that the mesh B leaves the exact surface of A or misses faces

Exit codes:
  0  same
  1  different, or reference suspect
  2  nothing usable: bad usage, a file that cannot be read
  130  stopped (Ctrl-C)";

const REGRESS_EXAMPLES: &str = "\
Examples:
  trimloop regress models/                        every CAD file with a mesh of the same name beside it
  trimloop regress suite.toml -o report/          the cases that the file lists
  trimloop regress suite.toml --tag freecad
  trimloop regress suite.toml --bless             after looking at report.html: this is how it should be

Writes results.json, junit.xml and report.html (one file, pictures inside) into the output folder.

A case passes where it is within its gates, or differs as its `known` entry or the baseline says. It fails where it
differs otherwise, where its verdict is not the baseline's, and where a known difference is there no more.

Exit codes:
  0  every case passed
  1  a case failed
  2  nothing usable: bad usage, a suite that cannot be read
  130  stopped (Ctrl-C)";

const INSPECT_EXAMPLES: &str = "\
Examples:
  trimloop inspect gearbox.step
  trimloop inspect gearbox.step --json | jq .surfaces";

/// `trimloop convert`.
#[derive(Args, Debug)]
pub struct ConvertArguments {
    /// STEP files (.step, .stp, .p21, also packed as .stpz or .stp.gz) and IGES files (.igs, .iges)
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Output file (.glb, or .gltf with its .bin) or folder [default: beside each input, as .glb]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,

    /// Number of threads, 0 for one per core
    #[arg(short, long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,

    /// Exit with 1 also when a face is only approximated: above the deflection, or by a fallback
    #[arg(long)]
    pub strict: bool,

    /// Print errors only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Print every diagnostic, and every face that is not exact
    #[arg(short, long)]
    pub verbose: bool,

    /// Largest distance between a triangle and the exact surface: mm, um, cm, m, in, or % of a part's diagonal
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "0.1%",
        help_heading = "Tolerance",
        value_parser = quantity::linear_deflection
    )]
    pub linear_deflection: LinearDeflection,

    /// Largest angle between the exact normals at the ends of a triangle's side: deg, rad
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "20deg",
        help_heading = "Tolerance",
        value_parser = quantity::angular_deflection
    )]
    pub angular_deflection: f64,

    /// Most triangles per part; faces that would need more are left above the deflection and reported
    #[arg(
        long,
        value_name = "N",
        default_value_t = 20_000_000,
        help_heading = "Tolerance",
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    pub max_triangles: u32,

    /// Axis that points up: y as glTF asks, z as most CAD files have it
    #[arg(long, value_enum, default_value_t = Up::Y, help_heading = "glTF")]
    pub up: Up,

    /// Add the faces' edges as lines
    #[arg(long, help_heading = "glTF")]
    pub edges: bool,

    /// Tell for each vertex which face it belongs to (_FEATURE_ID_0, an index into the mesh's
    /// extras.face_entities)
    #[arg(long, help_heading = "glTF")]
    pub face_ids: bool,

    /// Leave out what the file hides; without this it is converted like everything else
    #[arg(long, help_heading = "glTF")]
    pub skip_hidden: bool,

    /// Store positions and normals as integers (KHR_mesh_quantization)
    #[arg(long, help_heading = "glTF")]
    pub quantize: bool,

    /// Compress the geometry (EXT_meshopt_compression)
    #[arg(long, help_heading = "glTF")]
    pub meshopt: bool,

    /// Write a JSON report: a file, a folder or .jsonl for several inputs, - for standard output
    #[arg(long, value_name = "PATH", help_heading = "Report")]
    pub report: Option<PathBuf>,

    /// List every face in the report
    #[arg(long, requires = "report", help_heading = "Report")]
    pub report_faces: bool,
}

/// The axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Up {
    /// +Y.
    Y,
    /// +Z.
    Z,
}

impl ConvertArguments {
    /// What is asked of the mesh.
    pub fn mesh_options(&self) -> MeshOptions {
        MeshOptions {
            linear_deflection: self.linear_deflection,
            angular_deflection_rad: self.angular_deflection,
            max_triangles: self.max_triangles as usize,
        }
    }

    /// What is asked of the output.
    pub fn gltf_options(&self) -> GltfOptions {
        GltfOptions {
            up: match self.up {
                Up::Y => UpAxis::Y,
                Up::Z => UpAxis::Z,
            },
            edges: self.edges,
            face_ids: self.face_ids,
            quantize: self.quantize,
            meshopt: self.meshopt,
        }
    }
}

/// `trimloop view`.
#[derive(Args, Debug)]
pub struct ViewArguments {
    /// STEP and IGES files
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// Axis of the models that points up
    #[arg(long, value_enum, default_value_t = Up::Z)]
    pub up: Up,

    /// Colour the first file by its distance from this one, a mesh or a CAD file
    #[arg(long, value_name = "REFERENCE", requires = "inputs")]
    pub compare: Option<PathBuf>,

    /// Destroy the graphics device once the files are read; for tests
    #[arg(long, hide = true)]
    pub lose_device: bool,

    /// Where a window was that has lost its graphics device
    #[arg(long, hide = true, value_name = "VIEW", allow_hyphen_values = true)]
    pub resume: Option<trimloop_viewer::Resume>,
}

/// `trimloop render`.
#[derive(Args, Debug)]
pub struct RenderArguments {
    /// STEP and IGES files
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Picture (.png) or folder; a picture of several inputs is a contact sheet [default: beside each input]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,

    /// Number of threads, 0 for one per core
    #[arg(short, long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,

    /// Print errors only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Print what the file has to say, and what the picture took
    #[arg(short, long)]
    pub verbose: bool,

    /// Pixels; of a contact sheet those of each of its pictures [default: 1280x960, 320x240 in a contact sheet]
    #[arg(long, value_name = "WxH", help_heading = "Picture", value_parser = quantity::pixels)]
    pub size: Option<[u32; 2]>,

    /// Colour behind the model: a name, #rrggbb, or two of them with a comma, from top to bottom
    #[arg(long, value_name = "COLOR", help_heading = "Picture", value_parser = quantity::background)]
    pub background: Option<Background>,

    /// Nothing behind the model
    #[arg(long, conflicts_with = "background", help_heading = "Picture")]
    pub transparent: bool,

    /// Samples of a pixel: 1, 4, 8, 16, 32, 64
    #[arg(long, value_name = "N", default_value = "8", help_heading = "Picture", value_parser = quantity::samples)]
    pub samples: u32,

    /// The faces' edges: those that are seen, paler ones behind faces too, or none
    #[arg(
        long,
        value_enum,
        value_name = "KIND",
        default_value_t = Edges::Visible,
        num_args = 0..=1,
        default_missing_value = "visible",
        help_heading = "Picture"
    )]
    pub edges: Edges,

    /// From where: iso, front, back, left, right, top, bottom, or azimuth and elevation in degrees (30,20)
    #[arg(
        long,
        value_name = "VIEW",
        default_value = "iso",
        allow_hyphen_values = true,
        help_heading = "View",
        value_parser = quantity::view
    )]
    pub view: Direction,

    /// Axis of the model that points up
    #[arg(long, value_enum, default_value_t = Up::Z, help_heading = "View")]
    pub up: Up,

    /// Parallel instead of perspective
    #[arg(long, help_heading = "View")]
    pub ortho: bool,

    /// Fill the picture with what has this name instead of with all that is shown
    #[arg(long, value_name = "NAME", help_heading = "View")]
    pub fit: Vec<String>,

    /// Leave out what has this name (* stands for anything), and what is below it; may be given several times
    #[arg(long, value_name = "NAME", help_heading = "View")]
    pub hide: Vec<String>,

    /// Draw only what has this name, and what is below it; may be given several times
    #[arg(long, value_name = "NAME", help_heading = "View")]
    pub only: Vec<String>,

    /// Cut away what lies beyond a plane: x=10mm, or -x=10mm for the other side; what is cut is capped; may be given up to
    /// three times
    #[arg(
        long,
        value_name = "PLANE",
        allow_hyphen_values = true,
        help_heading = "View",
        value_parser = quantity::section
    )]
    pub section: Vec<Section>,

    /// As many pictures from all around: OUT_001.png, OUT_002.png, ...
    #[arg(long, value_name = "N", help_heading = "View", value_parser = clap::value_parser!(u32).range(1..=3600))]
    pub turntable: Option<u32>,

    /// Pixels that the picture may be off the exact model
    #[arg(long, value_name = "PX", default_value = "0.5", help_heading = "Exactness", value_parser = quantity::screen_error)]
    pub screen_error: f64,

    /// How levels of detail are chosen
    #[arg(long, value_name = "NAME", default_value = "adaptive", help_heading = "Exactness", value_parser = quantity::lod)]
    pub lod: Lod,

    /// Instead of drawing, tell what the pixel in a column of a row shows, as JSON
    #[arg(
        long,
        value_name = "X,Y",
        conflicts_with_all = ["turntable", "output"],
        help_heading = "Picking",
        value_parser = quantity::place
    )]
    pub pick: Option<[u32; 2]>,
}

/// Which edges are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Edges {
    /// None.
    None,
    /// Those that are seen.
    Visible,
    /// Those behind faces too.
    Hidden,
}

/// `trimloop compare`.
#[derive(Args, Debug)]
pub struct CompareArguments {
    /// The one shape: a CAD file or a mesh
    #[arg(value_name = "A")]
    pub a: PathBuf,

    /// The other, the reference where there is one
    #[arg(value_name = "B")]
    pub b: PathBuf,

    /// Places spread evenly over each side; the corners of the triangles come on top
    #[arg(long, value_name = "N", default_value_t = 200_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    pub samples: u32,

    /// Number of threads, 0 for one per core
    #[arg(short, long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,

    /// Print the verdict only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Print every face that differs, and what the files have to say
    #[arg(short, long)]
    pub verbose: bool,

    /// What is allowed
    #[command(flatten)]
    pub gates: GateArguments,

    /// Unit of meshes: mm, m, in, cm, ft, um, auto; A's and B's with a comma between them
    #[arg(long, value_name = "UNIT", default_value = "auto", value_delimiter = ',', num_args = 1, help_heading = "Files", value_parser = quantity::mesh_unit)]
    pub unit: Vec<MeshUnit>,

    /// Axis that points up in meshes: y, z, auto; A's and B's with a comma between them
    #[arg(
        long,
        value_name = "AXIS",
        default_value = "auto",
        value_delimiter = ',',
        num_args = 1,
        help_heading = "Files"
    )]
    pub up: Vec<MeshUp>,

    /// Compare what the file hides as well
    #[arg(long, help_heading = "Files")]
    pub hidden: bool,

    /// Write everything that was found as JSON: a file, or - for standard output
    #[arg(long, value_name = "PATH", help_heading = "Report")]
    pub report: Option<PathBuf>,

    /// Write one HTML file with figures and pictures
    #[arg(long, value_name = "PATH", help_heading = "Report")]
    pub html: Option<PathBuf>,
}

/// `trimloop regress`.
#[derive(Args, Debug)]
pub struct RegressArguments {
    /// The suite: a folder (its suite.toml, or its pairs of files), or a TOML file
    #[arg(value_name = "SUITE")]
    pub suite: PathBuf,

    /// Folder for results.json, junit.xml and report.html
    #[arg(short, long, value_name = "FOLDER", default_value = "trimloop-report")]
    pub output: PathBuf,

    /// Only cases whose name contains this; may be given several times
    #[arg(long, value_name = "WORD")]
    pub only: Vec<String>,

    /// Only cases with this tag; may be given several times
    #[arg(long, value_name = "TAG")]
    pub tag: Vec<String>,

    /// Take what comes as good: rewrite the baseline
    #[arg(long)]
    pub bless: bool,

    /// Leave out the pictures
    #[arg(long)]
    pub no_pictures: bool,

    /// Places spread evenly over each side; the corners of the triangles come on top
    #[arg(long, value_name = "N", default_value_t = 50_000, value_parser = clap::value_parser!(u32).range(1..=50_000_000))]
    pub samples: u32,

    /// Number of threads, 0 for one per core
    #[arg(short, long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,

    /// Print what failed and the sum only
    #[arg(short, long)]
    pub quiet: bool,

    /// What is allowed in cases that say nothing else
    #[command(flatten)]
    pub gates: GateArguments,
}

impl RegressArguments {
    /// Whether a case is to be run.
    pub fn chooses(&self, case: &trimloop_compare::Case) -> bool {
        let named = self.only.is_empty() || self.only.iter().any(|word| case.name.contains(word));
        named && (self.tag.is_empty() || case.tags.iter().any(|tag| self.tag.contains(tag)))
    }
}

/// What is allowed to differ.
#[derive(Args, Clone, Debug)]
pub struct GateArguments {
    /// Largest distance, both ways: mm, um, cm, m, in, or % of the diagonal of A
    #[arg(long, value_name = "LENGTH", default_value = "0.5%", help_heading = "Gates", value_parser = quantity::linear_deflection)]
    pub max_distance: LinearDeflection,

    /// Largest difference of the areas, % of A's
    #[arg(long, value_name = "SHARE", default_value = "1%", help_heading = "Gates", value_parser = quantity::share)]
    pub max_area: f64,

    /// Largest difference of the volumes, % of A's; where both sides close
    #[arg(long, value_name = "SHARE", default_value = "1%", help_heading = "Gates", value_parser = quantity::share)]
    pub max_volume: f64,

    /// Both sides must close
    #[arg(long, help_heading = "Gates")]
    pub watertight: bool,
}

impl GateArguments {
    /// As the library has them.
    pub fn gates(&self) -> Gates {
        Gates {
            max_distance: match self.max_distance {
                LinearDeflection::Absolute(mm) => Reach::Mm(mm),
                LinearDeflection::Relative(share) => Reach::Share(share),
            },
            max_area: self.max_area,
            max_volume: self.max_volume,
            watertight: self.watertight,
        }
    }
}

/// Millimetres per unit of a mesh, where that is not to be guessed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshUnit(pub Option<f64>);

/// The axis that points up in a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshUp {
    /// As the format has it, or as the boxes agree.
    Auto,
    /// +Y.
    Y,
    /// +Z.
    Z,
}

impl MeshUp {
    /// The axis, where that is not to be guessed.
    pub fn axis(self) -> Option<trimloop_compare::Up> {
        match self {
            Self::Auto => None,
            Self::Y => Some(trimloop_compare::Up::Y),
            Self::Z => Some(trimloop_compare::Up::Z),
        }
    }
}

/// `trimloop inspect`.
#[derive(Args, Debug)]
pub struct InspectArguments {
    /// STEP files (.step, .stp, .p21, also packed as .stpz or .stp.gz) and IGES files (.igs, .iges)
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Print JSON, one line per input
    #[arg(long)]
    pub json: bool,
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};
    use trimloop_mesh::{LinearDeflection, MeshOptions};

    use super::{Arguments, Command, ConvertArguments};

    fn convert(line: &str) -> ConvertArguments {
        let words = ["trimloop", "convert"].into_iter().chain(line.split_whitespace());
        match Arguments::try_parse_from(words).expect("valid arguments").command {
            Command::Convert(arguments) => arguments,
            other => panic!("parsed as {other:?}"),
        }
    }

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn defaults_are_those_of_the_libraries() {
        assert_eq!(convert("a.step").mesh_options(), MeshOptions::default());
    }

    #[test]
    fn gates_are_those_of_the_library() {
        let line = ["trimloop", "compare", "a.step", "b.stl", "--unit", "mm,in", "--up", "auto,y"];
        let Command::Compare(arguments) = Arguments::try_parse_from(line).expect("valid arguments").command
        else {
            panic!("not a comparison");
        };
        assert_eq!(arguments.gates.gates(), trimloop_compare::Gates::default());
        assert_eq!(arguments.unit, [super::MeshUnit(Some(1.0)), super::MeshUnit(Some(25.4))]);
        assert_eq!(arguments.up, [super::MeshUp::Auto, super::MeshUp::Y]);
    }

    #[test]
    fn tolerances_take_units() {
        let arguments = convert("a.step --linear-deflection 0.05mm --angular-deflection 5deg");
        assert_eq!(arguments.linear_deflection, LinearDeflection::Absolute(0.05));
        assert!((arguments.angular_deflection - 5f64.to_radians()).abs() < 1e-15);
    }

    #[test]
    fn nonsense_is_refused() {
        for line in ["", "a.step --linear-deflection -1", "a.step --max-triangles 0", "a.step -q -v"] {
            let words = ["trimloop", "convert"].into_iter().chain(line.split_whitespace());
            assert!(Arguments::try_parse_from(words).is_err(), "{line:?} was accepted");
        }
    }
}
