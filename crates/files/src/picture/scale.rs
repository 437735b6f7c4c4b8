//! The scale under a map of numbers from -1 to 1.

use super::signed;

/// Lines of a scale.
pub const HEIGHT: u32 = 22;

/// Lines of the bar, and of its marks under it.
const BAR: std::ops::Range<usize> = 3..11;
const MARKS: std::ops::Range<usize> = 11..14;
const LABELS: usize = 15;

/// Marks, and what stands under them.
const LABELLED: [(f64, &str); 5] = [(-1.0, "-1"), (-0.5, "-.5"), (0.0, "0"), (0.5, ".5"), (1.0, "1")];

/// Three columns of five lines, the leftmost column in the highest bit.
fn glyph(letter: char) -> [u8; 5] {
    match letter {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '-' => [0, 0, 0b111, 0, 0],
        '.' => [0, 0, 0, 0, 0b010],
        _ => [0; 5],
    }
}

/// The pixels of a scale so many columns wide.
pub fn of(width: u32) -> Vec<[u8; 3]> {
    let width = width as usize;
    let mut pixels = vec![[24; 3]; width * HEIGHT as usize];
    let mut plot = |x: usize, y: usize, color| {
        if x < width {
            pixels[y * width + x] = color;
        }
    };
    // Room for half a label at both ends.
    let (left, length) = (8, width.saturating_sub(17).max(1));
    for x in 0..=length {
        let value = 2.0 * x as f64 / length as f64 - 1.0;
        BAR.for_each(|y| plot(left + x, y, signed(value)));
    }
    for (value, label) in LABELLED {
        let at = left + ((value + 1.0) / 2.0 * length as f64).round() as usize;
        MARKS.for_each(|y| plot(at, y, [200; 3]));
        let from = at.saturating_sub(2 * label.len());
        for (place, letter) in label.chars().enumerate() {
            for (line, bits) in glyph(letter).into_iter().enumerate() {
                for column in (0..3).filter(|column| bits >> (2 - column) & 1 == 1) {
                    plot(from + 4 * place + column, LABELS + line, [200; 3]);
                }
            }
        }
    }
    pixels
}
