//! One law per file.

use crate::descriptor::LawDescriptor;

pub(crate) mod baber_noori_1985;
pub(crate) mod bilinear;
pub(crate) mod bouc_wen;
pub(crate) mod coulomb_friction;
pub(crate) mod elastic_perfectly_plastic;
pub(crate) mod elastoplastic_gap;
pub(crate) mod friction_pendulum;
pub(crate) mod gap_hook;
pub(crate) mod hyperbolic_gap;
pub(crate) mod ibarra_medina_krawinkler_2005_bilinear;
pub(crate) mod ibarra_medina_krawinkler_2005_peak_oriented;
pub(crate) mod ibarra_medina_krawinkler_2005_pinching;
pub(crate) mod iwan_six_parameter;
pub(crate) mod linear;
pub(crate) mod maxwell;
pub(crate) mod menegotto_pinto_1973;
pub(crate) mod modified_clough;
pub(crate) mod origin_oriented;
pub(crate) mod peak_oriented;
pub(crate) mod ramberg_osgood;
pub(crate) mod segalman_2005;
pub(crate) mod song_2004;
pub(crate) mod takeda;
pub(crate) mod viscous_damper;

/// Descriptors of all laws, in the order in which users see them.
pub(crate) static ALL: &[&LawDescriptor] = &[
    &linear::DESCRIPTOR,
    &bilinear::DESCRIPTOR,
    &elastic_perfectly_plastic::DESCRIPTOR,
    &ramberg_osgood::DESCRIPTOR,
    &bouc_wen::DESCRIPTOR,
    &baber_noori_1985::DESCRIPTOR,
    &menegotto_pinto_1973::DESCRIPTOR,
    &modified_clough::DESCRIPTOR,
    &peak_oriented::DESCRIPTOR,
    &origin_oriented::DESCRIPTOR,
    &takeda::DESCRIPTOR,
    &ibarra_medina_krawinkler_2005_bilinear::DESCRIPTOR,
    &ibarra_medina_krawinkler_2005_peak_oriented::DESCRIPTOR,
    &ibarra_medina_krawinkler_2005_pinching::DESCRIPTOR,
    &coulomb_friction::DESCRIPTOR,
    &friction_pendulum::DESCRIPTOR,
    &viscous_damper::DESCRIPTOR,
    &maxwell::DESCRIPTOR,
    &gap_hook::DESCRIPTOR,
    &elastoplastic_gap::DESCRIPTOR,
    &hyperbolic_gap::DESCRIPTOR,
    &iwan_six_parameter::DESCRIPTOR,
    &segalman_2005::DESCRIPTOR,
    &song_2004::DESCRIPTOR,
];
