//! Seeds of cases: from the seed of the study, the name of the case and the member, never from where a case stands in its table.

/// FNV-1a, 64 bits, of bytes: offset basis and prime of [FNV-DRAFT 3].
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// SplitMix64 [SPLITMIX-2014 5]: the number that follows a state.
fn split_mix(state: u64) -> u64 {
    let mut z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Seed of a member of a case, from 0 to 2^31 - 1: the upper 31 bits of SplitMix64 from the state
/// `SplitMix64(SplitMix64(study) xor FNV-1a(name)) xor member`, the name as its bytes in UTF-8.
///
/// # Example
/// ```
/// use windlass_study::seeds::seed_of_case;
///
/// assert_ne!(seed_of_case(1, "NORTH", 1), seed_of_case(1, "NORTH", 2));
/// ```
pub fn seed_of_case(study: u64, name: &str, member: u64) -> u64 {
    split_mix(split_mix(split_mix(study) ^ fnv1a(name.as_bytes())) ^ member) >> 33
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fnv_and_split_mix_give_published_numbers() {
        // the authors' test vectors: FNV-1a of "" , "a" and "foobar"; the first outputs of SplitMix64 from 1234567
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
        assert_eq!(split_mix(1_234_567), 6_457_827_717_110_365_317);
        assert_eq!(split_mix(1_234_567_u64.wrapping_add(0x9e37_79b9_7f4a_7c15)), 3_203_168_211_198_807_973);
    }
}
