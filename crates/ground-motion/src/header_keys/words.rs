//! The words of keys of header lines, in lower case with blanks for hyphens and underscores.

/// Ends of keys of a time step.
pub(super) const STEPS: [&str; 51] = [
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
    "per\u{ed}odo de muestreo",
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
    "pas d'\u{e9}chantillonnage",
    "pas d'echantillonnage",
    "intervalle de temps",
    "intervalle d'\u{e9}chantillonnage",
    // German.
    "zeitschritt",
    "zeitschrittweite",
    "zeitinkrement",
    "abtastintervall",
    // Turkish.
    "\u{f6}rnekleme aral\u{131}\u{11f}\u{131}",
    "zaman aral\u{131}\u{11f}\u{131}",
    "zaman ad\u{131}m\u{131}",
];
/// Keys of a time step where a unit of time says so: `delta` may be a distance, `interval` that of a window.
pub(super) const STEPS_BY_UNIT: [&str; 5] = ["delta", "interval", "step", "increment", "spacing"];
/// Ends of keys of a rate.
pub(super) const RATES: [&str; 32] = [
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
    "frecuencia de muestreo",
    "tasa de muestreo",
    "raz\u{f3}n de muestreo",
    "frequ\u{ea}ncia de amostragem",
    "frequencia de amostragem",
    "taxa de amostragem",
    "frequenza di campionamento",
    "fr\u{e9}quence d'\u{e9}chantillonnage",
    "frequence d'echantillonnage",
    "abtastrate",
    "abtastfrequenz",
    "samplingrate",
    "\u{f6}rnekleme frekans\u{131}",
    "\u{f6}rnekleme h\u{131}z\u{131}",
];
/// Keys of a count.
pub(super) const COUNTS: [&str; 11] = [
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
];
/// Words between `number` and what is counted.
pub(super) const OF_ALL: [&str; 7] = ["of", "the", "data", "total", "acceleration", "acc", "accel"];
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
pub(super) const PEAKS: [&str; 10] = [
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
pub(super) const FACTORS: [&str; 11] = [
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
/// Keys of a unit.
pub(super) const UNITS: [&str; 11] = [
    "unit",
    "units",
    "unidad",
    "unidades",
    "einheit",
    "einheiten",
    "unita",
    "unit\u{e0}",
    "unit\u{e9}",
    "unit\u{e9}s",
    "birim",
];
/// Words beside a key of the unit of the values.
pub(super) const OF_VALUES: [&str; 14] = [
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
    "aceleraci\u{f3}n",
];

/// Words of keys that speak of the record before it was processed.
pub(super) const OF_ANOTHER: [&str; 5] = ["original", "raw", "initial", "former", "native"];
/// Last words of keys that are the unit of their value: `timestep_s`, `sample rate, hz`.
pub(super) const LAST_UNITS: [&str; 8] = ["s", "sec", "secs", "seconds", "ms", "msec", "hz", "sps"];
