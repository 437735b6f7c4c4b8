//! Arrays and pictures of another rasterizer, read and checked.

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use edgewalk_judge::outside::Picture;
use edgewalk_judge::outside::picture::{COVERAGE, Floats, ID, LIT, Permitted, floats};
use edgewalk_scene::inputs;
use npyz::{Deserialize, NpyFile, Order};
use std::fs::File;
use std::io::{BufReader, Read, Seek as _};
use std::path::{Path, PathBuf};

/// What an array is called, in a folder or alone.
const NAMES: [&str; 5] = ["coverage.npy", "id.npy", "z.npy", "rgb.npy", "lit.npy"];

/// Longest header of an array that is read, bytes.
const MAX_HEADER: u64 = 1 << 16;
/// Most brackets that may be open at once in such a header: a dictionary, a list of fields, a field, its shape.
const MAX_BRACKETS: usize = 4;

/// Reads what these paths name: pictures of this size, whose depths and colours have so many bits where they are integers. Where
/// they are floats, `range` says what these may be.
pub fn read(paths: &[PathBuf], size: (u32, u32), bits: [u32; 2], range: Floats) -> Result<Picture> {
    let mut picture = Picture { width: size.0, height: size.1, ..Picture::default() };
    for path in paths {
        if path.is_dir() {
            let there: Vec<PathBuf> =
                NAMES.iter().map(|name| path.join(name)).filter(|file| file.exists()).collect();
            ensure!(
                !there.is_empty(),
                "{}: no array is there; permitted: one or more of {}, or give a .png",
                path.display(),
                NAMES.join(", ")
            );
            there.iter().try_for_each(|file| add(&mut picture, file, bits, range))?;
        } else {
            add(&mut picture, path, bits, range)?;
        }
    }
    Ok(picture)
}

/// Reads a file into its place.
fn add(picture: &mut Picture, path: &Path, [z_bits, color_bits]: [u32; 2], range: Floats) -> Result<()> {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let shown = || path.display().to_string();
    let twice = match name {
        "coverage.npy" => picture.coverage.is_some(),
        "id.npy" => picture.id.is_some(),
        "z.npy" => picture.z.is_some(),
        "lit.npy" => picture.lit.is_some(),
        _ => picture.rgb.is_some(),
    };
    let is_png = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"));
    ensure!(
        is_png || NAMES.contains(&name),
        "{}: the name says nothing of what the file holds; permitted: a folder, a .png, {}; rename it",
        shown(),
        NAMES.join(", ")
    );
    ensure!(!twice, "{}: given twice; permitted: each array once, and one picture", shown());
    let size = (picture.width, picture.height);
    if is_png {
        let (colors, bits) = png(path, size).with_context(shown)?;
        if bits != color_bits {
            picture.color_step = 1.0 / f64::from((1u32 << bits) - 1);
        }
        picture.rgb = Some(colors);
        return Ok(());
    }
    let colors = name == "rgb.npy";
    let array = Array::open(path, size, colors).with_context(shown)?;
    match name {
        "coverage.npy" => picture.coverage = Some(whole(array, &COVERAGE, size.0).with_context(shown)?),
        "id.npy" => picture.id = Some(whole(array, &ID, size.0).with_context(shown)?),
        "lit.npy" => picture.lit = Some(whole(array, &LIT, size.0).with_context(shown)?),
        "z.npy" => picture.z = Some(unorm(array, (z_bits, range), size.0, 1).with_context(shown)?),
        _ => {
            let values = unorm(array, (color_bits, range), size.0, 3).with_context(shown)?;
            picture.rgb = Some(values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect());
        }
    }
    Ok(())
}

/// The file, which no output may replace.
fn opened(path: &Path) -> std::io::Result<File> {
    let file = File::open(path)?;
    inputs::note(path);
    Ok(file)
}

/// Whether the numbers of a header are decimal and their product fits into 64 bits. Crate `npyz` multiplies the lengths of a shape and
/// panics beyond. A length of 0 counts as 1: `npyz` also multiplies parts of the shape.
fn are_countable(header: &str) -> bool {
    let words = header.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    let mut numbers = words.filter(|word| word.starts_with(|letter: char| letter.is_ascii_digit()));
    let product = numbers.try_fold(1u64, |all, number| all.checked_mul(number.parse::<u64>().ok()?.max(1)));
    product.is_some()
}

/// The most brackets that are open at once. Crate `npyz` takes twice the time for each.
fn brackets(header: &str) -> usize {
    let (mut open, mut most) = (0usize, 0);
    for letter in header.chars() {
        match letter {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open = open.saturating_sub(1),
            _ => {}
        }
        most = most.max(open);
    }
    most
}

/// An array whose shape is that of the screen.
struct Array(NpyFile<BufReader<File>>);

impl Array {
    fn open(path: &Path, (width, height): (u32, u32), colors: bool) -> Result<Array> {
        let mut file = BufReader::new(opened(path)?);
        // The length of the header is checked before memory is taken for it.
        let mut start = [0; 12];
        file.read_exact(&mut start)
            .context("is no numpy array: it is shorter than a header; write it with numpy.save")?;
        ensure!(start.starts_with(b"\x93NUMPY"), "no array of numpy: it does not begin with \\x93NUMPY");
        let (before, header) = match start[6] {
            1 => (10usize, u64::from(u16::from_le_bytes([start[8], start[9]]))),
            _ => (12, u64::from(u32::from_le_bytes([start[8], start[9], start[10], start[11]]))),
        };
        ensure!(header <= MAX_HEADER, "a header of {header} bytes; permitted: {MAX_HEADER}");
        let mut text = start[before..].to_vec();
        file.by_ref().take(header.saturating_sub(text.len() as u64)).read_to_end(&mut text)?;
        let text = String::from_utf8_lossy(&text);
        let deep = brackets(&text);
        ensure!(
            deep <= MAX_BRACKETS,
            "its header has brackets {deep} deep; permitted: {MAX_BRACKETS}; write the array with numpy.save"
        );
        ensure!(
            are_countable(&text),
            "its header has a length that is no decimal number, or more values than 64 bits count; permitted: {width} columns, {height} \
             lines"
        );
        file.rewind()?;
        // The error of a bad header quotes all of it below a first line, which is enough.
        let array = NpyFile::new(file).map_err(|error| {
            let error = error.to_string();
            anyhow!(
                "its header is none of numpy's ({}); permitted: a dictionary of descr, fortran_order and shape; write the array \
                 with numpy.save",
                error.lines().next().unwrap_or_default()
            )
        })?;
        let mut shape = vec![u64::from(height), u64::from(width)];
        shape.extend(colors.then_some(3));
        ensure!(
            array.shape() == shape,
            "its shape is {:?}; permitted: {shape:?}, lines from the top, columns{}",
            array.shape(),
            if colors { ", colours" } else { "" }
        );
        ensure!(
            array.order() == Order::C,
            "its order is Fortran's; permitted: C; numpy.ascontiguousarray makes it so"
        );
        Ok(Array(array))
    }

    /// The array's values, if they are of this type; else the array back.
    fn values<T: Deserialize>(self) -> Result<Result<Vec<T>>, Array> {
        match self.0.try_data::<T>() {
            Ok(values) => {
                Ok(values.collect::<Result<_, _>>().map_err(|e| anyhow!("its values end early: {e}")))
            }
            Err(array) => Err(Array(array)),
        }
    }

    fn of_another_type(&self, permitted: &str) -> anyhow::Error {
        anyhow!("its type is {}; permitted: {permitted}", self.0.dtype().descr())
    }
}

/// Tries one type of an array after the other.
macro_rules! by_type {
    ($array:ident, $($type:ty => $make:expr,)* else $permitted:expr) => {
        $(let $array = match $array.values::<$type>() {
            Ok(values) => return values.and_then($make),
            Err(array) => array,
        };)*
        return Err($array.of_another_type($permitted))
    };
}

/// Whole numbers of a picture with so many columns.
fn whole<T: TryFrom<i128>>(array: Array, of: &Permitted, columns: u32) -> Result<Vec<T>> {
    fn all<T: TryFrom<i128>, V: Into<i128>>(values: Vec<V>, of: &Permitted, columns: u32) -> Result<Vec<T>> {
        of.all(values.into_iter().map(Into::into), columns)
    }
    by_type!(array,
        bool => |v| all(v, of, columns),
        u8 => |v| all(v, of, columns),
        i8 => |v| all(v, of, columns),
        u16 => |v| all(v, of, columns),
        i16 => |v| all(v, of, columns),
        u32 => |v| all(v, of, columns),
        i32 => |v| all(v, of, columns),
        u64 => |v| all(v, of, columns),
        i64 => |v| all(v, of, columns),
        else "bool, or integers of 8 to 64 bits"
    );
}

/// Floats in this range, or unsigned integers in LSB of this many bits, of a picture with so many columns and `each` values a pixel.
fn unorm(array: Array, (bits, range): (u32, Floats), columns: u32, each: usize) -> Result<Vec<f64>> {
    let one = (1u64 << bits) - 1;
    let lsb = |value: u64| {
        ensure!(
            value <= one,
            "{value} is more than {one}, the most that {bits} bits hold; permitted: LSB, or floats in 0 to 1"
        );
        Ok(value as f64 / one as f64)
    };
    by_type!(array,
        f64 => |v| floats(v, range, columns, each),
        f32 => |v| floats(v.into_iter().map(f64::from).collect(), range, columns, each),
        u8 => |v| v.into_iter().map(|v| lsb(v.into())).collect(),
        u16 => |v| v.into_iter().map(|v| lsb(v.into())).collect(),
        u32 => |v| v.into_iter().map(|v| lsb(v.into())).collect(),
        u64 => |v| v.into_iter().map(lsb).collect(),
        else "float32, float64, or unsigned integers in LSB"
    );
}

/// The colours of a picture and the bits of each; what says how much of it is seen is left out.
fn png(path: &Path, (width, height): (u32, u32)) -> Result<(Vec<[f64; 3]>, u32)> {
    let mut decoder = png::Decoder::new(BufReader::new(opened(path)?));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info()?;
    let found = (reader.info().width, reader.info().height);
    ensure!(
        found == (width, height),
        "the picture has {}x{} pixels; permitted: {width}x{height}, the screen of the input; draw it in that size, or set \
         screen.width and screen.height where the input is a scene",
        found.0,
        found.1
    );
    let mut bytes = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut bytes)?;
    bytes.truncate(info.buffer_size());
    let (values, bits): (Vec<f64>, u32) = match info.bit_depth {
        png::BitDepth::Eight => (bytes.iter().map(|byte| f64::from(*byte) / 255.0).collect(), 8),
        png::BitDepth::Sixteen => {
            let words = bytes.chunks_exact(2).map(|word| u16::from_be_bytes([word[0], word[1]]));
            (words.map(|word| f64::from(word) / 65535.0).collect(), 16)
        }
        other => bail!("{other:?} bits a channel; permitted: 8 or 16"),
    };
    let samples = info.color_type.samples();
    let color = |pixel: &[f64]| if samples < 3 { [pixel[0]; 3] } else { [pixel[0], pixel[1], pixel[2]] };
    Ok((values.chunks_exact(samples).map(color).collect(), bits))
}
