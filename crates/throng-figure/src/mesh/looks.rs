//! The clothes of people and their colours.

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
    /// Hips and thighs.
    Trousers,
    /// Feet.
    Shoes,
    /// Shanks: covered or bare.
    Shins,
    /// The skirt of women and children, or the lower part of their coat. Only some looks wear it.
    Skirt,
    /// The lower part of the coat of men. Only some looks wear it.
    Coat,
    /// A rucksack. Only some looks wear it.
    Bag,
    /// Hair to the shoulders, of women and children. Only some looks have it.
    LongHair,
    /// A closed umbrella in the right hand. Only some looks carry it; blocks do not have it.
    Umbrella,
}

impl Region {
    /// All regions.
    pub const ALL: [Region; REGIONS] = [
        Region::Skin,
        Region::Hair,
        Region::Top,
        Region::Sleeves,
        Region::Trousers,
        Region::Shoes,
        Region::Shins,
        Region::Skirt,
        Region::Coat,
        Region::Bag,
        Region::LongHair,
        Region::Umbrella,
    ];

    /// Returns the name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Region::Skin => "skin",
            Region::Hair => "hair",
            Region::Top => "top",
            Region::Sleeves => "sleeves",
            Region::Trousers => "trousers",
            Region::Shoes => "shoes",
            Region::Shins => "shins",
            Region::Skirt => "skirt",
            Region::Coat => "coat",
            Region::Bag => "bag",
            Region::LongHair => "long hair",
            Region::Umbrella => "umbrella",
        }
    }
}

/// Number of regions.
const REGIONS: usize = 12;

/// The clothes of a person: the colour of each region, red, green, blue (sRGB), and which regions it wears.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Look {
    colours: [Option<[u8; 3]>; REGIONS],
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
const SKIRT: [[u8; 3]; 4] = [[62, 64, 74], [124, 58, 68], [72, 92, 120], [172, 150, 120]];
const TIGHTS: [u8; 3] = [44, 42, 46];
const BAG: [[u8; 3]; 5] = [[58, 62, 70], [150, 62, 48], [62, 92, 78], [182, 146, 84], [46, 66, 98]];
const UMBRELLA: [[u8; 3]; 3] = [[40, 42, 50], [120, 44, 52], [38, 74, 92]];

impl Look {
    /// Returns the look of a number. Numbers from 16 on repeat the looks.
    pub fn new(number: u8) -> Look {
        let number = usize::from(number % LOOKS);
        let skin = SKIN[(number * 5 + 1) % SKIN.len()];
        let top = TOP[(number * 3 + 2) % TOP.len()];
        let coat = number % 8 == 5;
        let bare = number % 3 == 1 && !coat;
        let skirt = matches!(number % 5, 2 | 4).then(|| SKIRT[number % SKIRT.len()]);
        let trousers = skirt.unwrap_or(TROUSERS[(number * 2 + number / 8) % TROUSERS.len()]);
        let shins = if skirt.is_none() {
            trousers
        } else if bare {
            skin
        } else {
            TIGHTS
        };
        let hair = HAIR[(number * 5 + number / 6) % HAIR.len()];
        Look {
            colours: [
                Some(skin),
                Some(hair),
                Some(top),
                Some(if bare { skin } else { top }),
                Some(trousers),
                Some(SHOES[(number + number / 4) % SHOES.len()]),
                Some(shins),
                if coat { Some(top) } else { skirt },
                coat.then_some(top),
                matches!(number % 7, 3 | 6).then(|| BAG[number % BAG.len()]),
                (number % 2 == 0).then_some(hair),
                (number % 8 == 1).then(|| UMBRELLA[number % UMBRELLA.len()]),
            ],
        }
    }

    /// Returns the colour of a region; `None` if the look does not wear it.
    pub fn colour(&self, region: Region) -> Option<[u8; 3]> {
        self.colours[region as usize]
    }

    /// Whether the look wears a region.
    pub fn wears(&self, region: Region) -> bool {
        self.colour(region).is_some()
    }

    /// Returns the regions that the look wears.
    pub fn worn(&self) -> Vec<Region> {
        Region::ALL.into_iter().filter(|&region| self.wears(region)).collect()
    }

    /// Whether a region has the colour of the top: the top itself, covered arms, and the lower part of a coat.
    pub fn is_top(&self, region: Region) -> bool {
        let top = self.colour(Region::Top);
        matches!(region, Region::Top | Region::Sleeves | Region::Skirt | Region::Coat) && self.colour(region) == top
    }
}
