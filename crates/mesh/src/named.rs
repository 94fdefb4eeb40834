//! Choices that have names in case files: declared once, each with its name.

/// Declares an enum and its `NAMES`: those of its variants that have one, in this order, each with its name; the others no case file may
/// name. A choice is added here alone.
#[macro_export]
macro_rules! named {
    ($(#[$about:meta])* $vis:vis enum $Choice:ident { $($(#[$what:meta])* $Variant:ident $(= $name:literal)?,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        $vis enum $Choice {
            $($(#[$what])* $Variant,)+
        }

        impl $Choice {
            /// Names as they stand in case files.
            pub const NAMES: [(&'static str, Self); [$($($name,)?)+].len()] = [$($(($name, Self::$Variant),)?)+];

            /// Its name; empty if it has none.
            #[must_use]
            pub fn name(self) -> &'static str {
                Self::NAMES.iter().find(|(_, named)| *named == self).map_or("", |(name, _)| name)
            }
        }
    };
}
