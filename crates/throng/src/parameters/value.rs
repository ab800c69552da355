//! The types of values that parameters can have.

use super::{Angle, Given, Kind, Written, shortest};
use crate::Error;
use crate::field::{FactorMap, Field};
use crate::space::Pathway;
use crate::space::surface::{Barrier, Surface};
use crate::steer::{Barriers, BoxedBehaviour, GroupFilter, Target};
use glam::{Vec2, Vec3};
use std::convert::Infallible;
use std::sync::Arc;

/// A type of values that parameters can have. [`parameters`](super::parameters) implements it for structs and enums.
pub trait Value: Sized {
    /// What the values are.
    const KIND: Kind;

    /// Reads a value from a file. A table gives some of the parameters of `usual` other values.
    ///
    /// # Errors
    /// The file gives another kind of value, names what the scene does not have, or a value is outside its limit.
    fn read<G: Given>(given: &G, usual: Option<Self>) -> Result<Self, G::Error>;

    /// Returns the value as files write it; `None` if it is not in files, or files cannot write it.
    fn write(&self) -> Option<Written> {
        None
    }

    /// Returns the value as a number, as files write it; `None` for other values than numbers.
    fn quantity(&self) -> Option<f64> {
        None
    }

    /// Checks the limit of each parameter of the value.
    ///
    /// # Errors
    /// [`Error::Limit`] names the first parameter that is outside its limit.
    fn check_limits(&self) -> Result<(), Error> {
        Ok(())
    }
}

impl Value for f32 {
    const KIND: Kind = Kind::Number;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.number().map(|number| number as Self)
    }

    fn write(&self) -> Option<Written> {
        self.is_finite().then(|| Written::Number(shortest(*self)))
    }

    /// Returns the number with the fewest digits that is this value in single precision.
    fn quantity(&self) -> Option<f64> {
        Some(shortest(*self))
    }
}

impl Value for f64 {
    const KIND: Kind = Kind::Number;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.number()
    }

    fn write(&self) -> Option<Written> {
        self.is_finite().then_some(Written::Number(*self))
    }

    fn quantity(&self) -> Option<f64> {
        Some(*self)
    }
}

impl Value for Angle {
    const KIND: Kind = Kind::Number;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.number().map(Self::degrees)
    }

    fn write(&self) -> Option<Written> {
        self.radians().is_finite().then(|| Written::Number(self.to_degrees()))
    }

    /// Returns the degrees.
    fn quantity(&self) -> Option<f64> {
        Some(self.to_degrees())
    }
}

/// Implements [`Value`] for types of whole numbers.
macro_rules! whole {
    ($($whole:ty)*) => { $(
        impl Value for $whole {
            const KIND: Kind = Kind::Whole;

            fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
                // the reader returns no number above the greatest of this type
                given.whole(Self::MAX as u64).map(|whole| whole as Self)
            }

            /// Returns `None` for the greatest number of the type: it stands for no limit.
            fn write(&self) -> Option<Written> {
                (*self < Self::MAX).then_some(Written::Whole(*self as u64))
            }

            fn quantity(&self) -> Option<f64> {
                Some(*self as f64)
            }
        }
    )* };
}

whole!(u32 u64 usize);

impl Value for bool {
    const KIND: Kind = Kind::Flag;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.flag()
    }

    fn write(&self) -> Option<Written> {
        Some(Written::Flag(*self))
    }
}

impl Value for String {
    const KIND: Kind = Kind::Text;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.text()
    }

    fn write(&self) -> Option<Written> {
        Some(Written::Text(self.clone().into()))
    }
}

/// An optional value: `None` is not in files.
impl<V: Value> Value for Option<V> {
    const KIND: Kind = V::KIND;

    fn read<G: Given>(given: &G, usual: Option<Self>) -> Result<Self, G::Error> {
        V::read(given, usual.flatten()).map(Some)
    }

    fn write(&self) -> Option<Written> {
        self.as_ref().and_then(V::write)
    }

    fn quantity(&self) -> Option<f64> {
        self.as_ref().and_then(V::quantity)
    }

    fn check_limits(&self) -> Result<(), Error> {
        self.as_ref().map_or(Ok(()), V::check_limits)
    }
}

impl<V: Value> Value for Box<V> {
    const KIND: Kind = V::KIND;

    fn read<G: Given>(given: &G, usual: Option<Self>) -> Result<Self, G::Error> {
        V::read(given, usual.map(|usual| *usual)).map(Self::new)
    }

    fn write(&self) -> Option<Written> {
        V::write(self)
    }

    fn quantity(&self) -> Option<f64> {
        V::quantity(self)
    }

    fn check_limits(&self) -> Result<(), Error> {
        V::check_limits(self)
    }
}

impl<V: Value> Value for Vec<V> {
    const KIND: Kind = Kind::List(&V::KIND);

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.list()?.iter().map(|given| V::read(given, None)).collect()
    }

    fn write(&self) -> Option<Written> {
        self.iter().map(V::write).collect::<Option<_>>().map(Written::List)
    }

    fn check_limits(&self) -> Result<(), Error> {
        self.iter().try_for_each(V::check_limits)
    }
}

impl<V: Value + Copy, const N: usize> Value for [V; N] {
    const KIND: Kind = Kind::Several(&V::KIND, N);

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        let values = Vec::<V>::read(given, None)?;
        let why = || format!("it has {} entries, and must have {N}", values.len());
        values.as_slice().try_into().map_err(|_| given.refused(Error::Shape { what: "this list".into(), why: why() }))
    }

    fn write(&self) -> Option<Written> {
        self.iter().map(V::write).collect::<Option<_>>().map(Written::List)
    }

    fn check_limits(&self) -> Result<(), Error> {
        self.iter().try_for_each(V::check_limits)
    }
}

/// Values by name, in the order of the names.
impl<V: Value> Value for Vec<(String, V)> {
    const KIND: Kind = Kind::Named(&V::KIND);

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.named()?.into_iter().map(|(name, given)| Ok((name, V::read(&given, None)?))).collect()
    }

    fn check_limits(&self) -> Result<(), Error> {
        self.iter().try_for_each(|(_, value)| value.check_limits())
    }
}

/// Implements [`Value`] for types that have no numbers and that files cannot write: those that names in a scene stand
/// for.
macro_rules! read_by {
    ($($(#[doc = $about:literal])* $kind:ident, $type:ty: $read:ident;)*) => { $(
        $(#[doc = $about])*
        impl Value for $type {
            const KIND: Kind = Kind::$kind;

            fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
                given.$read()
            }
        }
    )* };
}

read_by! {
    Obstacles, Barriers: obstacles;
    Surface, Barrier<Arc<dyn Surface>>: surface;
    Path, Arc<Pathway>: path;
    Field, Arc<dyn Field>: field;
    Map, Arc<dyn FactorMap>: map;
    Behaviour, BoxedBehaviour: behaviour;
}

impl Value for Target {
    const KIND: Kind = Kind::Target;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.target()
    }

    fn write(&self) -> Option<Written> {
        matches!(self, Self::Goal).then(|| Written::Text("goal".into()))
    }
}

impl Value for GroupFilter {
    const KIND: Kind = Kind::Groups;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.groups()
    }

    fn write(&self) -> Option<Written> {
        let name = match self {
            Self::All => "all",
            Self::OwnGroup => "own",
            Self::OtherGroups => "others",
            Self::Group(_) => return None,
        };
        Some(Written::Text(name.into()))
    }
}

/// A vector in metres, newtons or metres per second. For places see [`SpacePlace`] and [`GroundPlace`].
impl Value for Vec3 {
    const KIND: Kind = Kind::Vector;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.vector()
    }

    fn write(&self) -> Option<Written> {
        self.is_finite().then(|| Written::List(self.to_array().map(|x| Written::Number(shortest(x))).into()))
    }
}

/// A place in space: world coordinates in files, the coordinates of behaviours in code. A parameter of type `Vec3` is read
/// as a place by `#[parameter(from = SpacePlace)]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpacePlace(pub Vec3);

/// A place on the ground: world coordinates in files, the coordinates of behaviours in code. A parameter of type `Vec2` is
/// read as a place by `#[parameter(from = GroundPlace)]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundPlace(pub Vec2);

/// A figure of the rules: its name in files, its index in code. A parameter of type `usize` is read as a figure by
/// `#[parameter(from = FigureName)]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FigureName(pub usize);

impl From<FigureName> for usize {
    fn from(FigureName(index): FigureName) -> Self {
        index
    }
}

impl Value for FigureName {
    const KIND: Kind = Kind::Figure;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.figure().map(Self)
    }
}

impl From<SpacePlace> for Vec3 {
    fn from(SpacePlace(place): SpacePlace) -> Self {
        place
    }
}

impl From<GroundPlace> for Vec2 {
    fn from(GroundPlace(place): GroundPlace) -> Self {
        place
    }
}

impl Value for SpacePlace {
    const KIND: Kind = Kind::SpacePlace;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.space_place().map(Self)
    }
}

impl Value for GroundPlace {
    const KIND: Kind = Kind::GroundPlace;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        given.ground_place().map(Self)
    }
}

impl From<Infallible> for Error {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}
