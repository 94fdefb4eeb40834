//! Types that are another one with something about it, and are used as that.

/// Implements `Deref` and `DerefMut` of a type to that of one of its fields.
#[macro_export]
macro_rules! derefs {
    ([$($parameters:tt)*] $Outer:ty => $Inner:ty, $field:tt) => {
        impl<$($parameters)*> std::ops::Deref for $Outer {
            type Target = $Inner;

            fn deref(&self) -> &Self::Target {
                &self.$field
            }
        }

        impl<$($parameters)*> std::ops::DerefMut for $Outer {
            fn deref_mut(&mut self) -> &mut Self::Target {
                &mut self.$field
            }
        }
    };
}
