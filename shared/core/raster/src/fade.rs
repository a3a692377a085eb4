//! Fading one picture into another: how trails end.

/// Move every byte of `pixels` towards that of `target`, keeping `keep` / 256 of the difference.
///
/// With `keep` below 256 every byte arrives in the end: the difference is rounded towards nothing, so no ghost stays.
pub fn fade(pixels: &mut [u8], target: &[u8], keep: u16) {
    let keep = keep.min(256);
    for (pixel, &goal) in pixels.iter_mut().zip(target) {
        let rest = ((u16::from(pixel.abs_diff(goal)) * keep) >> 8) as u8;
        *pixel = if *pixel > goal { goal + rest } else { goal - rest };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_arrives() {
        let mut pixels: Vec<u8> = (0..=255).collect();
        let target = vec![100; 256];
        for _ in 0..255 {
            fade(&mut pixels, &target, 255);
        }
        assert_eq!(pixels, target);
    }

    #[test]
    fn half_of_the_difference_stays() {
        let mut pixels = [200, 0, 100];
        fade(&mut pixels, &[100, 100, 100], 128);
        assert_eq!(pixels, [150, 50, 100]);
    }

    #[test]
    fn keeping_all_changes_nothing() {
        let mut pixels = [200, 0, 100];
        fade(&mut pixels, &[100, 100, 100], 256);
        assert_eq!(pixels, [200, 0, 100]);
    }
}
