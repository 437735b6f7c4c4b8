//! The checksum of `cksum` (POSIX): the order of a sample, and whether a file is what it was.

/// As `cksum` prints it first: CRC-32 of the bytes and then of their number, high bits first.
pub fn cksum(bytes: &[u8]) -> u32 {
    let mut sum = 0u32;
    let mut add = |byte: u8| {
        sum ^= u32::from(byte) << 24;
        for _ in 0..8 {
            sum = if sum >> 31 == 1 { (sum << 1) ^ 0x04C1_1DB7 } else { sum << 1 };
        }
    };
    for &byte in bytes {
        add(byte);
    }
    let mut length = bytes.len();
    while length > 0 {
        add((length & 0xFF) as u8);
        length >>= 8;
    }
    !sum
}

#[cfg(test)]
mod tests {
    #[test]
    fn as_the_command_has_it() {
        assert_eq!(super::cksum(b""), 4294967295);
        assert_eq!(super::cksum(b"123456789"), 930766865);
    }
}
