//! SAC and miniSEED, written byte by byte.

use pounding_ground_motion::{Quantity, ReadOptions};

use super::*;

const ACC: Quantity = Quantity::Acceleration;
/// Counts per m/s2.
pub const SENSITIVITY: f64 = 200_000.0;

pub fn sac(written: i64) -> Vec<Fixture> {
    let mut all = Vec::new();
    for big in [false, true] {
        for uneven in [false, true] {
            let values: Vec<f32> = signal(0.4, 0.2).iter().map(|a| *a as f32).collect();
            let times: Vec<f32> = (0..COUNT)
                .map(|i| (i * i) as f32 * 0.001 + i as f32 * 0.01)
                .collect();
            let mut floats = [-12345.0_f32; 70];
            floats[0] = 0.01;
            floats[5] = 0.0;
            floats[6] = (COUNT - 1) as f32 * 0.01;
            floats[1] = values.iter().copied().fold(f32::INFINITY, f32::min);
            floats[2] = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let mut integers = [-12345_i32; 40];
            integers[6] = 6;
            integers[9] = i32::try_from(written).unwrap();
            integers[15] = 1;
            integers[16] = 8;
            integers[35] = i32::from(!uneven);
            let mut bytes = Vec::new();
            let mut put = |four: [u8; 4]| {
                let mut four = four;
                if big {
                    four.reverse();
                }
                bytes.extend(four);
            };
            floats.iter().for_each(|x| put(x.to_le_bytes()));
            integers.iter().for_each(|x| put(x.to_le_bytes()));
            bytes.extend(b"STA     EVENT           ");
            bytes.extend(b"-12345  ".repeat(17));
            bytes.extend(b"HNZ     XX      ");
            bytes.extend(b"-12345  ".repeat(2));
            assert_eq!(bytes.len(), 632);
            let mut put = |x: f32| {
                bytes.extend(if big {
                    x.to_be_bytes()
                } else {
                    x.to_le_bytes()
                });
            };
            values.iter().for_each(|x| put(*x));
            if uneven {
                times.iter().for_each(|x| put(*x));
            }
            let samples: Vec<f64> = values.iter().map(|a| f64::from(*a)).collect();
            let mut series = truth(ACC, "HNZ", &samples, G, 0.01);
            if uneven {
                series.times = Some(times.iter().map(|t| f64::from(*t)).collect());
            }
            all.push(Fixture {
                name: "sac",
                format: "sac",
                bytes,
                options: in_g(),
                truth: vec![series],
                counted: false,
            });
        }
    }
    all
}

/// A record of 512 bytes.
pub struct Seed<'a> {
    pub channel: &'a [u8; 3],
    pub encoding: u8,
    pub big: bool,
    /// Time of the first sample after midnight (1e-4 s).
    pub start: u32,
    pub count: u16,
    pub data: Vec<u8>,
}

pub fn record(seed: &Seed<'_>) -> Vec<u8> {
    let two = |x: u16| {
        if seed.big {
            x.to_be_bytes()
        } else {
            x.to_le_bytes()
        }
    };
    let mut bytes = b"000001D XXXXX  ".to_vec();
    bytes.extend(seed.channel);
    bytes.extend(b"XX");
    bytes.extend(two(2000));
    bytes.extend(two(1));
    bytes.extend([0, 0, u8::try_from(seed.start / 10_000).unwrap(), 0]);
    bytes.extend(two(u16::try_from(seed.start % 10_000).unwrap()));
    bytes.extend(two(seed.count));
    bytes.extend(two(100));
    bytes.extend(two(1));
    bytes.extend([0, 0, 0, 1, 0, 0, 0, 0]);
    bytes.extend(two(64));
    bytes.extend(two(48));
    bytes.extend(two(1000));
    bytes.extend(two(0));
    bytes.extend([seed.encoding, u8::from(seed.big), 9, 0]);
    bytes.resize(64, 0);
    bytes.extend(&seed.data);
    assert!(bytes.len() <= 512);
    bytes.resize(512, 0);
    bytes
}

/// Words of a Steim frame in the byte order.
fn frame(codes: &[u32], words: &[u32], big: bool) -> Vec<u8> {
    let head = codes
        .iter()
        .enumerate()
        .fold(0_u32, |head, (i, c)| head | c << (2 * (15 - i as u32 - 1)));
    let mut bytes = Vec::new();
    for word in std::iter::once(&head).chain(words) {
        bytes.extend(if big {
            word.to_be_bytes()
        } else {
            word.to_le_bytes()
        });
    }
    bytes.resize(64, 0);
    bytes
}

/// Ways to pack differences in a word: code, upper bits, bits each, number.
const STEIM_1: [(u32, u32, u32, usize); 3] = [(1, 0, 8, 4), (2, 0, 16, 2), (3, 0, 32, 1)];
const STEIM_2: [(u32, u32, u32, usize); 7] = [
    (3, 2, 4, 7),
    (3, 1, 5, 6),
    (3, 0, 6, 5),
    (1, 0, 8, 4),
    (2, 3, 10, 3),
    (2, 2, 15, 2),
    (2, 1, 30, 1),
];

/// Differences in the tightest words, frame after frame. Both versions in both byte
/// orders decode as those that libmseed writes; see the order of bytes and halves.
pub fn steim(values: &[i32], version: u8, big: bool) -> Vec<u8> {
    let ways: &[_] = if version == 1 { &STEIM_1 } else { &STEIM_2 };
    let mut left: Vec<i32> = vec![0];
    left.extend(values.windows(2).map(|w| w[1].wrapping_sub(w[0])));
    let mut bytes = Vec::new();
    let mut at = 0;
    while at < left.len() || bytes.is_empty() {
        let (mut codes, mut words) = (Vec::new(), Vec::new());
        if bytes.is_empty() {
            codes.extend([0, 0]);
            words.extend([values[0] as u32, values[values.len() - 1] as u32]);
        }
        while words.len() < 15 && at < left.len() {
            let fits = |bits: u32, n: usize| {
                at + n <= left.len()
                    && left[at..at + n]
                        .iter()
                        .all(|d| (i64::from(*d) << (64 - bits)) >> (64 - bits) == i64::from(*d))
            };
            let (code, upper, bits, n) = *ways.iter().find(|w| fits(w.2, w.3)).unwrap();
            let mask = if bits == 32 {
                u32::MAX
            } else {
                (1 << bits) - 1
            };
            let packed = left[at..at + n]
                .iter()
                .fold(0_u64, |word, d| word << bits | u64::from(*d as u32 & mask));
            codes.push(code);
            let word = packed as u32
                | if version == 2 && code > 1 {
                    upper << 30
                } else {
                    0
                };
            // Bytes and halves stand in the order of the file whatever the byte order.
            words.push(match bits {
                8 if !big => word.swap_bytes(),
                16 if !big => word.rotate_left(16),
                _ => word,
            });
            at += n;
        }
        bytes.extend(frame(&codes, &words, big));
    }
    bytes
}

/// Counts whose differences need every packing.
pub fn counts() -> Vec<i32> {
    let mut values = vec![-7, 1, 0, -1, 2, 3, -4, 5];
    for difference in [
        9,
        -12,
        25,
        -30,
        17,
        -100,
        90,
        400,
        -500,
        9000,
        -16_000,
        400_000_000,
        -3,
    ] {
        values.push(values[values.len() - 1] + difference);
    }
    values.push(values[0]);
    values.push(30_000);
    assert_eq!(values.len(), COUNT);
    values
}

pub fn mini_seed() -> Vec<Fixture> {
    let mut all = Vec::new();
    for encoding in [1_u8, 2, 3, 4, 5, 10, 11] {
        for big in [true, false] {
            let limit = match encoding {
                1 => 15,
                2 => 23,
                // A difference of Steim-2 has 30 bits at most.
                _ => 29,
            };
            let values: Vec<i32> = counts()
                .iter()
                .map(|c| (*c).clamp(-(1 << limit), (1 << limit) - 1))
                .collect();
            // Two records, the later one first; the second continues the first.
            let mut bytes = Vec::new();
            let (head, tail) = values.split_at(10);
            for (part, start) in [(tail, 2_100_u32), (head, 1_100)] {
                let ordered = |mut b: Vec<u8>| {
                    if !big {
                        b.reverse();
                    }
                    b
                };
                let data = match encoding {
                    10 => steim(part, 1, big),
                    11 => steim(part, 2, big),
                    _ => part
                        .iter()
                        .flat_map(|c| {
                            ordered(match encoding {
                                1 => (*c as i16).to_be_bytes().to_vec(),
                                2 => c.to_be_bytes()[1..].to_vec(),
                                3 => c.to_be_bytes().to_vec(),
                                4 => (*c as f32).to_be_bytes().to_vec(),
                                _ => f64::from(*c).to_be_bytes().to_vec(),
                            })
                        })
                        .collect(),
                };
                bytes.extend(record(&Seed {
                    channel: b"HNE",
                    encoding,
                    big,
                    start,
                    count: u16::try_from(part.len()).unwrap(),
                    data,
                }));
            }
            let samples: Vec<f64> = values
                .iter()
                .map(|c| {
                    if encoding == 4 {
                        f64::from(*c as f32)
                    } else {
                        f64::from(*c)
                    }
                })
                .collect();
            all.push(Fixture {
                name: "mini_seed",
                format: "mini_seed_2",
                bytes,
                options: ReadOptions {
                    sensitivity: Some(SENSITIVITY),
                    ..ReadOptions::default()
                },
                truth: vec![truth(ACC, "HNE", &samples, 1.0 / SENSITIVITY, 0.01)],
                counted: false,
            });
        }
    }
    all
}

/// The little-endian SAC file at even steps with other words of its header, counted from 0: numbers,
/// integers (70 to 109), and the name of the component (eight characters).
pub fn sac_with(floats: &[(usize, f32)], integers: &[(usize, i32)], component: &str) -> Vec<u8> {
    let mut bytes = sac(COUNT as i64).remove(0).bytes;
    for (word, value) in floats {
        bytes[4 * word..4 * word + 4].copy_from_slice(&value.to_le_bytes());
    }
    for (word, value) in integers {
        bytes[4 * word..4 * word + 4].copy_from_slice(&value.to_le_bytes());
    }
    bytes[600..608].copy_from_slice(format!("{component:<8}").as_bytes());
    bytes
}
