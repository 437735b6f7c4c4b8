//! Tokens as hex digits.

use crate::Token;

/// The values side by side, the first on top, in `ceil(sum of widths / 4)` hex digits.
#[must_use]
pub fn pack(widths: &[u32], values: &[u128]) -> String {
    let bits: Vec<bool> = widths
        .iter()
        .zip(values)
        .flat_map(|(width, value)| (0..*width).rev().map(move |bit| value >> bit & 1 == 1))
        .collect();
    // Digits are counted from the right.
    let digit = |bits: &[bool]| bits.iter().fold(0, |digit, bit| digit * 2 + u32::from(*bit));
    let digits: Vec<u32> = bits.rchunks(4).map(digit).collect();
    digits.iter().rev().filter_map(|digit| char::from_digit(*digit, 16)).collect()
}

/// The reverse of [`pack`]; `None` if the text is not as long as it should be, or no hex number.
#[must_use]
pub fn unpack(widths: &[u32], text: &str) -> Option<Token> {
    let total: u32 = widths.iter().sum();
    if text.len() != total.div_ceil(4) as usize || text.chars().any(|c| c.is_ascii_uppercase()) {
        return None;
    }
    let mut bits = Vec::new();
    for c in text.chars() {
        let digit = c.to_digit(16)?;
        bits.extend((0..4).rev().map(|bit| digit >> bit & 1 == 1));
    }
    let (padding, mut bits) = bits.split_at(bits.len() - total as usize);
    if padding.contains(&true) {
        return None;
    }
    let mut token = Token::new();
    for width in widths {
        let (field, rest) = bits.split_at(*width as usize);
        token.push(field.iter().fold(0, |value, bit| value << 1 | u128::from(*bit)));
        bits = rest;
    }
    Some(token)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packs_the_first_field_on_top() {
        assert_eq!(pack(&[4, 8], &[0xa, 0xbc]), "abc");
        assert_eq!(pack(&[1, 3, 5], &[1, 0, 1]), "101");
        assert_eq!(pack(&[1], &[1]), "1");
        assert_eq!(pack(&[128, 2], &[u128::MAX, 1]), "3fffffffffffffffffffffffffffffffd");
    }

    #[test]
    fn reads_back() {
        let widths = [1, 38, 22, 5, 64];
        let token = vec![1, 0x3_1234_5678, 0x2f_0001, 30, u128::from(u64::MAX)];
        assert_eq!(unpack(&widths, &pack(&widths, &token)), Some(token));
        for faulty in ["", "1", "xyz", "ABC", "fff"] {
            assert_eq!(unpack(&[4, 7], faulty), None, "{faulty}");
        }
    }
}
