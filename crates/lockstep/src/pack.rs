//! Tokens as hex digits.

use crate::Token;

/// The values side by side, the first on top, as one number in as few lower-case hex digits as it has.
#[must_use]
pub fn pack(widths: &[u32], values: &[u128]) -> String {
    let mut digits = Vec::new(); // the least significant first
    let (mut rest, mut bits) = (0u128, 0);
    for (width, value) in widths.iter().zip(values).rev() {
        // In two parts, so that what is left of the fields below, at most three bits, has room beside them.
        for (low, part) in [(0, width.min(&64)), (64, &width.saturating_sub(64))] {
            rest |= (value >> low & ((1 << part) - 1)) << bits;
            bits += part;
            while bits >= 4 {
                digits.push(HEX[(rest & 15) as usize]);
                (rest, bits) = (rest >> 4, bits - 4);
            }
        }
    }
    digits.push(HEX[(rest & 15) as usize]);
    while digits.len() > 1 && digits.last() == Some(&'0') {
        digits.pop();
    }
    digits.iter().rev().collect()
}

const HEX: [char; 16] = ['0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'a', 'b', 'c', 'd', 'e', 'f'];

/// The reverse of [`pack`]; `None` if the text is no lower-case hex number, or one of more bits.
#[must_use]
pub fn unpack(widths: &[u32], text: &str) -> Option<Token> {
    let total: u32 = widths.iter().sum();
    let digits = total.div_ceil(4) as usize;
    if text.is_empty() || text.len() > digits || text.chars().any(|c| c.is_ascii_uppercase()) {
        return None;
    }
    let mut bits = vec![false; 4 * (digits - text.len())];
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
        assert_eq!(pack(&[24, 8], &[0, 0x0c]), "c", "no digit without need");
        assert_eq!(pack(&[16], &[0]), "0");
        assert_eq!(pack(&[1], &[1]), "1");
        assert_eq!(pack(&[128, 2], &[u128::MAX, 1]), "3fffffffffffffffffffffffffffffffd");
    }

    #[test]
    fn reads_back() {
        let widths = [1, 38, 22, 5, 64];
        let token = vec![1, 0x3_1234_5678, 0x2f_0001, 30, u128::from(u64::MAX)];
        assert_eq!(unpack(&widths, &pack(&widths, &token)), Some(token));
        assert_eq!(unpack(&[4, 7], "1"), Some(vec![0, 1]), "shorter");
        for faulty in ["", "xyz", "ABC", "fff", "0001", "+1"] {
            assert_eq!(unpack(&[4, 7], faulty), None, "{faulty}");
        }
    }
}
