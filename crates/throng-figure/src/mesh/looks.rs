//! The colours of people.

/// Number of looks.
pub const LOOKS: u8 = 16;

/// A region of the body with one colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Region {
    /// Face, neck and hands.
    Skin,
    /// Hair.
    Hair,
    /// Trunk and upper arms.
    Top,
    /// Forearms: covered or bare.
    Sleeves,
    /// Legs.
    Trousers,
    /// Feet.
    Shoes,
}

impl Region {
    /// All regions.
    pub const ALL: [Region; 6] =
        [Region::Skin, Region::Hair, Region::Top, Region::Sleeves, Region::Trousers, Region::Shoes];
}

/// The colours of a person: red, green, blue (sRGB) of each region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Look {
    colours: [[u8; 3]; 6],
}

const SKIN: [[u8; 3]; 6] =
    [[241, 206, 178], [224, 180, 148], [198, 145, 110], [161, 108, 76], [117, 76, 53], [84, 56, 41]];
const HAIR: [[u8; 3]; 6] = [[35, 28, 25], [62, 44, 33], [96, 68, 45], [154, 112, 66], [48, 40, 40], [150, 146, 142]];
const TOP: [[u8; 3]; 8] = [
    [58, 84, 122],
    [178, 66, 58],
    [224, 222, 214],
    [66, 104, 82],
    [210, 164, 76],
    [86, 82, 92],
    [120, 156, 184],
    [130, 74, 104],
];
const TROUSERS: [[u8; 3]; 5] = [[44, 56, 84], [52, 52, 56], [120, 108, 88], [72, 78, 84], [84, 64, 52]];
const SHOES: [[u8; 3]; 4] = [[38, 34, 32], [92, 62, 42], [196, 194, 190], [60, 64, 76]];

impl Look {
    /// Returns the look of a number. Numbers from 16 on repeat the looks.
    pub fn new(number: u8) -> Look {
        let number = usize::from(number % LOOKS);
        let skin = SKIN[(number * 5 + 1) % SKIN.len()];
        let top = TOP[(number * 3 + 2) % TOP.len()];
        Look {
            colours: [
                skin,
                HAIR[(number * 5 + number / 6) % HAIR.len()],
                top,
                if number % 3 == 1 { skin } else { top },
                TROUSERS[(number * 2 + number / 8) % TROUSERS.len()],
                SHOES[(number + number / 4) % SHOES.len()],
            ],
        }
    }

    /// Returns the colour of a region.
    pub fn colour(&self, region: Region) -> [u8; 3] {
        self.colours[region as usize]
    }
}
