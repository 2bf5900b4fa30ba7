//! Pages, in one program.

mod page;
mod studies;
