//! The words of keys of header lines, in lower case, letters without their marks, with blanks for hyphens and
//! underscores.

/// Ends of keys of a time step.
pub(super) const STEPS: [&str; 53] = [
    "equally spaced intervals of",
    "equal intervals of",
    "equal spacing of",
    "intervalo de amostra",
    "dt",
    "delta t",
    "deltat",
    "\u{3b4}t",
    "time step",
    "timestep",
    "time step size",
    "time interval",
    "time increment",
    "time spacing",
    "sampling interval",
    "sample interval",
    "sampling period",
    "sampling step",
    "sampling time",
    "sample period",
    "sample time",
    "sample spacing",
    "data interval",
    "digitisation interval",
    "digitization interval",
    "digitizing interval",
    "recording interval",
    // Spanish and Portuguese.
    "paso de tiempo",
    "paso temporal",
    "intervalo de tiempo",
    "intervalo de muestreo",
    "incremento de tiempo",
    "periodo de muestreo",
    "paso de muestreo",
    "delta de tiempo",
    "passo de tempo",
    "intervalo de tempo",
    "intervalo de amostragem",
    // Italian.
    "passo temporale",
    "passo di campionamento",
    "intervallo di campionamento",
    "intervallo di tempo",
    // French.
    "pas de temps",
    "pas d'echantillonnage",
    "intervalle de temps",
    "intervalle d'echantillonnage",
    // German.
    "zeitschritt",
    "zeitschrittweite",
    "zeitinkrement",
    "abtastintervall",
    // Turkish.
    "ornekleme araligi",
    "zaman araligi",
    "zaman adimi",
];
/// Keys of a time step where a unit of time says so: `delta` may be a distance, `interval` that of a window.
pub(super) const STEPS_BY_UNIT: [&str; 5] = ["delta", "interval", "step", "increment", "spacing"];
/// Ends of keys of a rate.
pub(super) const RATES: [&str; 29] = [
    "frequence d'echantillonnage",
    "frecuencia de muestreo",
    "fs",
    "sampling rate",
    "sample rate",
    "samplerate",
    "samplingrate",
    "sampling frequency",
    "samplingfrequency",
    "sampling freq",
    "sample frequency",
    "samples per second",
    "samples/second",
    "samples/sec",
    "samples/s",
    "sps",
    "digitisation rate",
    "digitization rate",
    "acquisition rate",
    "recording rate",
    "tasa de muestreo",
    "razon de muestreo",
    "frequencia de amostragem",
    "taxa de amostragem",
    "frequenza di campionamento",
    "abtastrate",
    "abtastfrequenz",
    "ornekleme frekansi",
    "ornekleme hizi",
];
/// Keys of a count.
pub(super) const COUNTS: [&str; 35] = [
    "npts",
    "count",
    "ndata",
    "nsamples",
    "npoints",
    "samples",
    "points",
    "values",
    "data",
    "data points",
    "sample count",
    // Spanish, Portuguese and Italian.
    "muestras",
    "datos",
    "puntos",
    "amostras",
    "dados",
    "pontos",
    "campioni",
    "dati",
    "punti",
    // French and German.
    "echantillons",
    "donnees",
    "werte",
    "punkte",
    "datenpunkte",
    "messwerte",
    "abtastwerte",
    // Turkish, whose word for a number stands behind.
    "veri sayisi",
    "nokta sayisi",
    "ornek sayisi",
    "toplam veri sayisi",
    "toplam nokta sayisi",
    "toplam veri",
    "veri adedi",
    "nokta adedi",
];
/// Keys of a count that alone are a heading.
pub(super) const HEADINGS: [&str; 7] = [
    "data", "values", "datos", "dados", "dati", "donnees", "werte",
];
/// Words before what is counted.
pub(super) const NUMBERS_OF: [&str; 12] = [
    "number",
    "no",
    "num",
    "nr",
    "n\u{b0}",
    "n\u{ba}",
    "numero",
    "cantidad",
    "quantidade",
    "nombre",
    "anzahl",
    "zahl",
];
/// Words between `number` and what is counted.
pub(super) const OF_ALL: [&str; 17] = [
    "of",
    "the",
    "data",
    "total",
    "acceleration",
    "acc",
    "accel",
    "de",
    "del",
    "los",
    "las",
    "dos",
    "das",
    "di",
    "d",
    "der",
    "totale",
];
/// Keys of a rate, unless it is of something slow.
pub(super) const FREQUENCIES: [&str; 5] = ["frequency", "freq", "frecuencia", "frequenza", "rate"];
/// Keys of a length of the record.
pub(super) const DURATIONS: [&str; 6] = [
    "duration",
    "total duration",
    "record duration",
    "duration of record",
    "record length",
    "length of record",
];
/// Keys of a largest acceleration.
pub(super) const PEAKS: [&str; 33] = [
    "amax",
    "acc max",
    "pga",
    "peak acceleration",
    "peak acc",
    "peak accel",
    "peak ground acceleration",
    "max acceleration",
    "max acc",
    "maximum acceleration",
    "maximum acc",
    "peak value",
    // Spanish and Portuguese.
    "aceleracion maxima",
    "maxima aceleracion",
    "aceleracion maxima del suelo",
    "aceleracion pico",
    "aceleracao maxima",
    "aceleracao de pico",
    "valor maximo",
    // Italian.
    "accelerazione massima",
    "accelerazione di picco",
    "valore massimo",
    // French.
    "acceleration maximale",
    "acceleration maximum",
    "acceleration max",
    "valeur maximale",
    // German.
    "maximale beschleunigung",
    "maximalbeschleunigung",
    "spitzenbeschleunigung",
    "maximalwert",
    // Turkish.
    "en buyuk ivme",
    "maksimum ivme",
    "pik ivme",
];
/// Keys of what the values are.
pub(super) const QUANTITIES: [&str; 7] = [
    "type",
    "data type",
    "quantity",
    "record type",
    "series type",
    "signal type",
    "kind",
];
/// Keys of a factor of the values.
pub(super) const FACTORS: [&str; 20] = [
    "sf",
    "mult",
    "calib",
    "factor de escala",
    "fator de escala",
    "fattore di scala",
    "facteur d'echelle",
    "skalierungsfaktor",
    "olcek",
    "scale",
    "scale factor",
    "scaling",
    "scaling factor",
    "factor",
    "multiplier",
    "multiply by",
    "conversion factor",
    "calibration factor",
    "amplitude factor",
    "gain",
];
/// Words before a factor of the values.
pub(super) const BEFORE_FACTORS: [&str; 8] = [
    "multiplied by",
    "multiply by",
    "scaled by",
    "scale factor",
    "scaling factor",
    "values x",
    "values *",
    "values times",
];
/// Words before a number by which the values were divided.
pub(super) const BEFORE_DIVISORS: [&str; 1] = ["divided by"];
/// Words before the number of samples of which one was kept.
pub(super) const BEFORE_DECIMATIONS: [&str; 5] = [
    "decimated by",
    "downsampled by",
    "decimation factor",
    "decimation ratio",
    "decimation",
];
/// What may stand between such words and their number.
pub(super) const BEFORE_NUMBERS: [&str; 9] =
    [" ", "\t", "=", ":", "a ", "the ", "of ", "by ", "factor "];
/// Keys of a unit.
pub(super) const UNITS: [&str; 12] = [
    "unidade",
    "birimi",
    "unites",
    "unite",
    "unit",
    "units",
    "unidad",
    "unidades",
    "einheit",
    "einheiten",
    "unita",
    "birim",
];
/// Words beside a key of the unit of the values.
pub(super) const OF_VALUES: [&str; 20] = [
    "di",
    "misura",
    "medicion",
    "aceleracao",
    "ivme",
    "accelerazione",
    "data",
    "value",
    "values",
    "y",
    "axis",
    "ordinate",
    "amplitude",
    "amplitudes",
    "of",
    "de",
    "the",
    "measure",
    "medida",
    "aceleracion",
];

/// Words of keys that speak of the record before it was processed.
pub(super) const OF_ANOTHER: [&str; 28] = [
    "originale",
    "originali",
    "originales",
    "ursprungliche",
    "ursprunglicher",
    "orijinal",
    "cruda",
    "crudo",
    "brute",
    "before",
    "from",
    "adc",
    "gps",
    "analysis",
    "newmark",
    "critical",
    "minimum",
    "maximum",
    "spatial",
    "opensees",
    "integration",
    "solver",
    "window",
    "original",
    "raw",
    "initial",
    "former",
    "native",
];
/// Last words of keys that are the unit of their value: `timestep_s`, `sample rate, hz`.
pub(super) const LAST_UNITS: [&str; 8] = ["s", "sec", "secs", "seconds", "ms", "msec", "hz", "sps"];
/// Units of rates, of which none is one, too.
pub(super) const HERTZ: [&str; 13] = [
    "",
    "hz",
    "hertz",
    "sps",
    "samples/s",
    "samples/sec",
    "samples/second",
    "samples per second",
    "muestras/s",
    "campioni/s",
    "1/s",
    "1/sec",
    "/s",
];
