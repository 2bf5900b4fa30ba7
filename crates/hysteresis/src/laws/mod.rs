//! One law per file.

use crate::descriptor::LawDescriptor;

/// Declares the files of the laws and lists their descriptors: one line per law.
macro_rules! laws {
    ($($name:ident)*) => {
        $(pub(crate) mod $name;)*
        /// Descriptors of all laws, in the order in which users see them.
        pub(crate) static ALL: &[&LawDescriptor] = &[$(&$name::DESCRIPTOR),*];
    };
}

laws! {
    linear
    bilinear
    elastic_perfectly_plastic
    ramberg_osgood
    bouc_wen
    baber_noori_1985
    menegotto_pinto_1973
    modified_clough
    peak_oriented
    origin_oriented
    takeda
    ibarra_medina_krawinkler_2005_bilinear
    ibarra_medina_krawinkler_2005_peak_oriented
    ibarra_medina_krawinkler_2005_pinching
    coulomb_friction
    viscous_damper
    maxwell
    gap_hook
    elastoplastic_gap
    iwan_six_parameter
    segalman_2005
    song_2004
}
