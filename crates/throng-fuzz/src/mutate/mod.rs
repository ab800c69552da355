//! Mutants: inputs changed at a few places.
//!
//! Input `k` of a target and seed is file `k` of the corpus, unchanged. After the files, input `k` is a mutant: a
//! function of the corpus, the seed, the target's name and `k`.

mod bytes;
mod text;

use crate::Target;
use crate::corpus::Sample;
use crate::rng::Rng;

/// Greatest size of an input, bytes.
const LARGEST: usize = 1 << 20;

/// Returns input `number` of a target.
pub fn input(target: &Target, corpus: &[Sample], seed: u64, number: u64) -> Vec<u8> {
    match usize::try_from(number).ok().and_then(|number| corpus.get(number)) {
        Some(sample) => sample.bytes.clone(),
        None => mutant(target, corpus, Rng::of(seed, target.name, number)),
    }
}

/// Returns a file of the corpus, changed at one to six places. Few changes are more likely: an input with many changes
/// is rejected early.
fn mutant(target: &Target, corpus: &[Sample], mut rng: Rng) -> Vec<u8> {
    let mut out = rng.pick(corpus).bytes.clone();
    let most = 1 + rng.below(6);
    for _ in 0..=rng.below(most) {
        let other = &rng.pick(corpus).bytes;
        let is_text = std::str::from_utf8(&out).is_ok();
        if is_text && rng.below(4) > 0 {
            let text = String::from_utf8_lossy(&out);
            out = text::changed(&text, &String::from_utf8_lossy(other), &mut rng).into_bytes();
        } else {
            bytes::change(&mut out, other, &mut rng);
        }
        out.truncate(LARGEST);
    }
    // most readers stop at a wrong checksum
    if let Some(seal) = target.seal.filter(|_| rng.below(4) > 0) {
        seal(&mut out);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TARGETS;

    #[test]
    fn mutants_are_functions_of_seed_and_number() {
        let target = &TARGETS[0];
        let sample = |text: &str| Sample { name: String::new(), bytes: text.into() };
        let corpus = [sample("number,time,x,y\n1,0,2,3\n1,0.5,2,3\n"), sample("a = [1, 2]\nb = { c = 3 }\n")];
        let all = |seed| (0..200).map(|k| input(target, &corpus, seed, k)).collect::<Vec<_>>();
        let first = all(1);
        assert_eq!(first[..2], [corpus[0].bytes.clone(), corpus[1].bytes.clone()]);
        assert_eq!(first, all(1));
        let different = first[2..].iter().zip(&all(2)[2..]).filter(|(a, b)| a != b).count();
        assert!(different > 190, "{different}");
    }
}
