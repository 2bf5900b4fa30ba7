//! Pages, in one program.

mod answer_file;
mod page;
mod studies;
