//! One published model a file.

use crate::descriptor::ModelDescriptor;

/// Declares the files of the models and lists their descriptors: one line per model.
macro_rules! models {
    ($($name:ident)*) => {
        $(pub(crate) mod $name;)*
        /// Descriptors of all models, in the order in which users see them.
        pub(crate) static ALL: &[&ModelDescriptor] = &[$(&$name::DESCRIPTOR),*];
    };
}

models! {
    linear_elastic
    hertz_1882
    exact_hunt_crossley
    exact_hunt_crossley_approach
    exact_kelvin_voigt
    exact_linear
    exact_linear_approach
    anagnostopoulos_2004
    komodromos_2007
    modelica_elasto_gap
    mahmoud_jankowski_2011
    jankowski_2005
    tsuji_1992
    ye_li_2009
    pant_2010
    papi_toopchi_2022
    polycarpou_2013
    muthukumar_desroches_2006
    ye_li_zhu_2009
    hunt_crossley_1975
    herbert_mcwhannell_1977
    lee_wang_1983
    lankarani_nikravesh_1990
    gonthier_2004
    zhiying_qishao_2006
    gharib_hurmuzlu_2012
    hu_guo_2015
    carvalho_martins_2019
    safaeifar_farshidianfar_2020
    muthukumar_2003
    adams_impact
    kuwabara_kono_1987
    borovin_2014
    lapshin_yurin_2016
    stereomechanical
}
