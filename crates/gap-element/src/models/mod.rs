//! One published model a file.

use crate::descriptor::ModelDescriptor;

pub(crate) mod adams_impact;
pub(crate) mod anagnostopoulos_2004;
pub(crate) mod borovin_2014;
pub(crate) mod carvalho_martins_2019;
pub(crate) mod exact_hunt_crossley;
pub(crate) mod exact_hunt_crossley_approach;
pub(crate) mod exact_kelvin_voigt;
pub(crate) mod exact_linear;
pub(crate) mod exact_linear_approach;
pub(crate) mod gharib_hurmuzlu_2012;
pub(crate) mod gonthier_2004;
pub(crate) mod herbert_mcwhannell_1977;
pub(crate) mod hertz_1882;
pub(crate) mod hu_guo_2015;
pub(crate) mod hunt_crossley_1975;
pub(crate) mod jankowski_2005;
pub(crate) mod komodromos_2007;
pub(crate) mod kuwabara_kono_1987;
pub(crate) mod lankarani_nikravesh_1990;
pub(crate) mod lapshin_yurin_2016;
pub(crate) mod lee_wang_1983;
pub(crate) mod linear_elastic;
pub(crate) mod mahmoud_jankowski_2011;
pub(crate) mod modelica_elasto_gap;
pub(crate) mod muthukumar_2003;
pub(crate) mod muthukumar_desroches_2006;
pub(crate) mod pant_2010;
pub(crate) mod papi_toopchi_2022;
pub(crate) mod polycarpou_2013;
pub(crate) mod safaeifar_farshidianfar_2020;
pub(crate) mod stereomechanical;
pub(crate) mod tsuji_1992;
pub(crate) mod ye_li_2009;
pub(crate) mod ye_li_zhu_2009;
pub(crate) mod zhiying_qishao_2006;

/// Descriptors of all models, in the order in which users see them.
pub(crate) static ALL: &[&ModelDescriptor] = &[
    &linear_elastic::DESCRIPTOR,
    &hertz_1882::DESCRIPTOR,
    &exact_hunt_crossley::DESCRIPTOR,
    &exact_hunt_crossley_approach::DESCRIPTOR,
    &exact_kelvin_voigt::DESCRIPTOR,
    &exact_linear::DESCRIPTOR,
    &exact_linear_approach::DESCRIPTOR,
    &anagnostopoulos_2004::DESCRIPTOR,
    &komodromos_2007::DESCRIPTOR,
    &modelica_elasto_gap::DESCRIPTOR,
    &mahmoud_jankowski_2011::DESCRIPTOR,
    &jankowski_2005::DESCRIPTOR,
    &tsuji_1992::DESCRIPTOR,
    &ye_li_2009::DESCRIPTOR,
    &pant_2010::DESCRIPTOR,
    &papi_toopchi_2022::DESCRIPTOR,
    &polycarpou_2013::DESCRIPTOR,
    &muthukumar_desroches_2006::DESCRIPTOR,
    &ye_li_zhu_2009::DESCRIPTOR,
    &hunt_crossley_1975::DESCRIPTOR,
    &herbert_mcwhannell_1977::DESCRIPTOR,
    &lee_wang_1983::DESCRIPTOR,
    &lankarani_nikravesh_1990::DESCRIPTOR,
    &gonthier_2004::DESCRIPTOR,
    &zhiying_qishao_2006::DESCRIPTOR,
    &gharib_hurmuzlu_2012::DESCRIPTOR,
    &hu_guo_2015::DESCRIPTOR,
    &carvalho_martins_2019::DESCRIPTOR,
    &safaeifar_farshidianfar_2020::DESCRIPTOR,
    &muthukumar_2003::DESCRIPTOR,
    &adams_impact::DESCRIPTOR,
    &kuwabara_kono_1987::DESCRIPTOR,
    &borovin_2014::DESCRIPTOR,
    &lapshin_yurin_2016::DESCRIPTOR,
    &stereomechanical::DESCRIPTOR,
];
