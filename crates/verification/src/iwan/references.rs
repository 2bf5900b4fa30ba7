//! What the publication on the six-parameter Iwan model and independent evaluations give.

use pounding_hysteresis::iwan::IwanDensity;

/// Parameters at which the publication's formulas were evaluated by quadrature of the
/// density and by Masing's rule, which agree in 16 digits.
pub const DOCUMENT: IwanDensity = IwanDensity {
    density: 2.0e6,
    exponent: -0.3,
    phi_1: 1.0e-5,
    phi_2: 1.0e-4,
    slider_stiffness: 3.0e3,
    residual_stiffness: 1.0e3,
};
/// Initial stiffness (N/m).
pub const INITIAL_STIFFNESS: f64 = 7624.758361269359;
/// Force of the sliders when all of them slip (N).
pub const SLIP_FORCE: f64 = 0.48273769598346233;
/// Deformation (m) and force (N) on the backbone.
pub const BACKBONE: [(f64, f64); 3] = [
    (5.0e-6, 0.03812379180634679),
    (5.0e-5, 0.34070843194269673),
    (2.0e-4, 0.6827376959834623),
];
/// Amplitude (m), deformation (m) and force (N) on unloading.
pub const UNLOADING: [(f64, f64, f64); 5] = [
    (6.0e-5, 5.0e-5, 0.31995422853556704),
    (6.0e-5, -2.0e-5, -0.16641311093078895),
    (2.5e-4, 2.4e-4, 0.6564901123707687),
    (2.5e-4, 1.0e-4, -0.21238562906897937),
    (2.5e-4, -1.0e-4, -0.5827376959834624),
];
/// Amplitude (m) and dissipation of a cycle (J).
pub const DISSIPATION: [(f64, f64); 7] = [
    (2.0e-5, 1.542154861298726e-7),
    (5.0e-5, 3.600682763675368e-6),
    (6.0e-5, 6.1556352448237424e-6),
    (1.0e-4, 2.6228977214097663e-5),
    (2.0e-4, 2.1932405560748258e-4),
    (2.5e-4, 3.1587159480417506e-4),
    (4.0e-4, 6.055142123942524e-4),
];

/// Exponent alpha of the publication's figures of dissipation.
pub const FIGURE_EXPONENT: f64 = -0.3;
/// Curves over beta, with kappa_2 = 0.
pub const BETAS: [f64; 5] = [0.0, 0.2, 0.4, 0.6, 0.8];
/// Curves over kappa_2, with beta = 0.
pub const KAPPAS: [f64; 5] = [0.0, 0.5, 1.0, 2.0, 5.0];

/// Amplitude over phi_2, and `4 int phi (A - phi) rho dphi` without dimension for each
/// beta: quadrature in 30 digits, agreeing with `8 int F dx - 4 A F(A)` over the
/// backbone, itself by quadrature.
pub const OVER_BETA: [(f64, [f64; 5]); 9] = [
    (0.1, [0.0017387906884260389, 0.0, 0.0, 0.0, 0.0]),
    (0.2, [0.011298695227487669, 0.0, 0.0, 0.0, 0.0]),
    (
        0.5,
        [
            0.13411159186763794,
            0.07705318096882521,
            0.011134535393014627,
            0.0,
            0.0,
        ],
    ),
    (
        0.8,
        [
            0.47707896749062156,
            0.3742608409204838,
            0.20542815617354324,
            0.06020067359653031,
            0.0,
        ],
    ),
    (
        1.0,
        [
            0.8714596949891068,
            0.7381350913047523,
            0.5006930471103916,
            0.2571127355662354,
            0.0723524244423156,
        ],
    ),
    (
        1.5,
        [
            2.047930283224401,
            1.8383394867545046,
            1.429374043941594,
            0.9399116599795793,
            0.4437522550371858,
        ],
    ),
    (
        2.0,
        [
            3.224400871459695,
            2.938543882204257,
            2.3580550407727965,
            1.6227105843929233,
            0.815152085632056,
        ],
    ),
    (
        5.0,
        [
            10.28322440087146,
            9.539770254902772,
            7.930141021760011,
            5.719504130872987,
            3.043551069201277,
        ],
    ),
    (
        10.0,
        [
            22.0479302832244,
            20.541814209400293,
            17.216950990072036,
            12.547493375006425,
            6.757549375149979,
        ],
    ),
];
/// The same for each kappa_2.
pub const OVER_KAPPA: [(f64, [f64; 5]); 9] = [
    (0.1, [0.0017387906884260389; 5]),
    (0.2, [0.011298695227487669; 5]),
    (0.5, [0.13411159186763794; 5]),
    (0.8, [0.47707896749062156; 5]),
    (1.0, [0.8714596949891068; 5]),
    (
        1.5,
        [
            2.047930283224401,
            3.047930283224401,
            4.047930283224401,
            6.047930283224401,
            12.047930283224401,
        ],
    ),
    (
        2.0,
        [
            3.224400871459695,
            5.224400871459695,
            7.224400871459695,
            11.224400871459695,
            23.224400871459697,
        ],
    ),
    (
        5.0,
        [
            10.28322440087146,
            18.28322440087146,
            26.28322440087146,
            42.28322440087146,
            90.28322440087146,
        ],
    ),
    (
        10.0,
        [
            22.0479302832244,
            40.0479302832244,
            58.0479302832244,
            94.0479302832244,
            202.0479302832244,
        ],
    ),
];

/// Slope of dissipation over amplitude that the publication measured in a bolted joint.
pub const EXPERIMENT_SLOPE: f64 = 2.83;
/// Slope that its model has.
pub const MODEL_SLOPE: f64 = 2.87;
