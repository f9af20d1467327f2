//! The CRC-32 of zip and PNG.

/// Of the bytes so far.
///
/// ```
/// use fixel_demos::crc::Crc;
/// let mut crc = Crc::default();
/// crc.add(b"1234");
/// crc.add(b"56789");
/// assert_eq!(crc.value(), 0xcbf4_3926);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Crc(u32);

impl Default for Crc {
    fn default() -> Self {
        Crc(!0)
    }
}

impl Crc {
    /// These too.
    pub fn add(&mut self, bytes: &[u8]) {
        const REVERSED_POLYNOMIAL: u32 = 0xedb8_8320;
        for &byte in bytes {
            self.0 = (0..8).fold(self.0 ^ byte as u32, |crc, _| {
                (crc >> 1) ^ if crc & 1 != 0 { REVERSED_POLYNOMIAL } else { 0 }
            });
        }
    }

    /// What it has come to.
    pub fn value(self) -> u32 {
        !self.0
    }
}
