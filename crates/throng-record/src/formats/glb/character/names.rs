//! The names of joints in files of other programs.

use throng_figure::Joint;

/// The names of the joints without a side, the preferred first. The names of a side are those of the left.
const NAMES: [(Joint, &[&str]); 12] = [
    (Joint::Hips, &["hips", "pelvis", "hip"]),
    (Joint::Spine, &["spine", "spine01", "spine001", "abdomen"]),
    (Joint::Spine1, &["chest", "spine1", "spine02", "spine002", "torso"]),
    (Joint::Neck, &["neck", "neck01", "spine004"]),
    (Joint::Head, &["head", "spine006"]),
    (Joint::LeftArm, &["upperarm", "arm", "uparm"]),
    (Joint::LeftForeArm, &["forearm", "lowerarm", "lowarm"]),
    (Joint::LeftHand, &["hand", "wrist", "palm", "fist"]),
    (Joint::LeftUpLeg, &["upleg", "upperleg", "thigh"]),
    (Joint::LeftLeg, &["leg", "lowerleg", "shin", "calf", "lowleg"]),
    (Joint::LeftFoot, &["foot", "ankle"]),
    (Joint::LeftToeBase, &["toebase", "toes", "toe", "ball", "toe0"]),
];

/// Words at the start or end of names that say nothing about the joint: of Mixamo, VRM (`J_Bip_C_`), Biped (`Bip01`) and Rigify
/// (`DEF-`).
const EMPTY: [&str; 8] = ["j", "c", "def", "bip", "bone", "jnt", "joint", "bind"];

/// A side of a name.
#[derive(Clone, Copy, PartialEq)]
enum NameSide {
    Left,
    Right,
    None,
}

/// Returns the words of a name, in lower case: separated by characters that are no letters or digits, and where a lower-case letter is
/// before an upper-case letter.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut lower = false;
    for letter in name.chars() {
        if !letter.is_ascii_alphanumeric() || lower && letter.is_ascii_uppercase() {
            words.push(String::new());
        }
        if letter.is_ascii_alphanumeric() {
            words.last_mut().expect("there is a word").push(letter.to_ascii_lowercase());
        }
        lower = letter.is_ascii_lowercase();
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Returns the name of a joint without its side and without empty words, and its side.
fn split(name: &str) -> (String, NameSide) {
    // without the namespace
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    let mut side = NameSide::None;
    let mut key = String::new();
    for word in words(name) {
        let plain = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
        match word.as_str() {
            "l" | "left" if side == NameSide::None => side = NameSide::Left,
            "r" | "right" if side == NameSide::None => side = NameSide::Right,
            _ if plain == "mixamorig" || EMPTY.contains(&plain) => {}
            _ => key.push_str(&word),
        }
    }
    (key, side)
}

/// Returns the joint that a name means, and the place of the name among the names of the joint: the smaller, the more preferred.
fn meant(name: &str) -> Option<(Joint, usize)> {
    let (key, side) = split(name);
    NAMES.into_iter().find_map(|(joint, names)| {
        let rank = names.iter().position(|&known| known == key)?;
        let sided = joint.index() >= Joint::LeftArm.index();
        match (sided, side) {
            (false, NameSide::None) | (true, NameSide::Left) => Some((joint, rank)),
            (true, NameSide::Right) => Some((right(joint), rank)),
            _ => None,
        }
    })
}

/// Returns the joint of the right side.
fn right(left: Joint) -> Joint {
    let name = left.name().replace("Left", "Right");
    Joint::ALL.into_iter().find(|joint| joint.name() == name).unwrap_or(left)
}

/// Returns which of the named nodes is each joint, in the order of [`Joint::ALL`].
///
/// # Errors
/// Two nodes are one joint.
pub(super) fn mapped<'a>(
    nodes: impl Iterator<Item = (usize, &'a str)>,
) -> Result<[Option<usize>; throng_figure::JOINTS], String> {
    let nodes: Vec<(usize, &str)> = nodes.collect();
    let mut found: [Option<(usize, usize, &str)>; throng_figure::JOINTS] = [None; throng_figure::JOINTS];
    // the metarig of Rigify begins with `spine` at the hips
    let hips = nodes.iter().any(|(_, name)| matches!(meant(name), Some((Joint::Hips, _))));
    let rigify = !hips && nodes.iter().any(|(_, name)| split(name).0 == "spine001");
    for &(node, name) in &nodes {
        let Some((joint, rank)) = meant(name) else { continue };
        let (joint, rank) = if rigify && joint == Joint::Spine && rank == 0 { (Joint::Hips, 0) } else { (joint, rank) };
        let known = &mut found[joint.index()];
        match *known {
            Some((other, best, other_name)) if best == rank && other != node => {
                let which = joint.name();
                return Err(format!(
                    "two joints are {which}: `{other_name}` (node {other}) and `{name}` (node {node}); a file holds one body"
                ));
            }
            Some((_, best, _)) if best <= rank => {}
            _ => *known = Some((node, rank, name)),
        }
    }
    let mut found = found.map(|known| known.map(|(node, ..)| node));
    // the only joint of a spine carries the arms
    let (spine, chest) = (Joint::Spine.index(), Joint::Spine1.index());
    if found[chest].is_none() {
        found.swap(spine, chest);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_programs_are_known() {
        use Joint::{
            Head, Hips, LeftArm, LeftFoot, LeftForeArm, LeftHand, LeftLeg, LeftToeBase, LeftUpLeg, Neck, RightArm,
            RightLeg, RightToeBase, RightUpLeg, Spine, Spine1,
        };
        for (name, joint) in [
            ("mixamorig:Hips", Hips),
            ("mixamorig1:LeftUpLeg", LeftUpLeg),
            ("mixamorigSpine1", Spine1),
            ("Spine", Spine),
            ("LeftToeBase", LeftToeBase),
            ("J_Bip_C_Hips", Hips),
            ("J_Bip_L_UpperLeg", LeftUpLeg),
            ("J_Bip_R_ToeBase", RightToeBase),
            ("J_Bip_C_Chest", Spine1),
            ("upper_arm.L", LeftArm),
            ("forearm.L", LeftForeArm),
            ("DEF-thigh.R", RightUpLeg),
            ("shin.R", RightLeg),
            ("thigh_l", LeftUpLeg),
            ("calf_r", RightLeg),
            ("ball_l", LeftToeBase),
            ("spine_02", Spine1),
            ("neck_01", Neck),
            ("pelvis", Hips),
            ("Bip01 L Thigh", LeftUpLeg),
            ("Bip001 Head", Head),
            ("UpperArm.R", RightArm),
            ("leftLowerLeg", LeftLeg),
            ("LEFT_FOOT", LeftFoot),
            ("Armature|hand.L", LeftHand),
        ] {
            assert_eq!(meant(name).map(|(joint, _)| joint), Some(joint), "{name}");
        }
        for name in [
            "",
            "mixamorig:LeftHandThumb1",
            "LeftToe_End",
            "HeadTop_End",
            "thigh_twist_01_l",
            "DEF-thigh.L.001",
            "LeftShoulder",
            "Arm",
            "LeftHips",
            "ORG-thigh.L",
            "clavicle_l",
            "Root",
        ] {
            assert_eq!(meant(name), None, "{name}");
        }
    }

    #[test]
    fn every_joint_has_a_name_of_its_own() {
        let nodes: Vec<(usize, &str)> = Joint::ALL.iter().map(|joint| (joint.index(), joint.name())).collect();
        assert_eq!(mapped(nodes.into_iter()).unwrap(), std::array::from_fn(Some));
    }

    #[test]
    fn preferred_names_win_and_the_only_spine_is_the_chest() {
        let found = mapped([(4, "wrist.L"), (5, "hand.L"), (6, "spine"), (7, "hips")].into_iter()).unwrap();
        assert_eq!(found[Joint::LeftHand.index()], Some(5));
        assert_eq!((found[Joint::Spine.index()], found[Joint::Spine1.index()]), (None, Some(6)));
        let rigify = ["spine", "spine.001", "spine.002", "spine.003", "spine.004", "spine.006"];
        let found = mapped(rigify.into_iter().enumerate()).unwrap();
        assert_eq!(found[..5], [Some(0), Some(1), Some(2), Some(4), Some(5)]);
        let twice = mapped([(1, "Hips"), (9, "mixamorig:Hips")].into_iter()).unwrap_err();
        assert!(twice.starts_with("two joints are Hips: `Hips` (node 1) and `mixamorig:Hips` (node 9)"), "{twice}");
    }
}
