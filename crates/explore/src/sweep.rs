//! Many machines on the same frames, each a row.
//!
//! ```text
//!  definition ─> grid ─> points ─┬─ same pixels? ─> drawn and compared once ─┐
//!                                └─ timing keys ──> clock, or ticks ─────────┴─> rows ─> store ─> check ─> table, bests,
//!                                                                                                        fronts, report
//! ```
//! A row is what `edgewalk render --json` says of its machine, with what identifies it.
//!
//! ```
//! use edgewalk_explore::sweep::evaluate::{Around, missing, run};
//! use edgewalk_explore::sweep::table::Table;
//! use edgewalk_explore::sweep::{Definition, Store, Sweep, store};
//!
//! # fn main() -> anyhow::Result<()> {
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("runs.jsonl");
//! let definition = Definition {
//!     inputs: vec!["sphere".to_owned()],
//!     vary: vec!["interpolator.adders=1,2,4".to_owned(), "formats.z_fraction=6..9".to_owned()],
//!     ..Definition::default()
//! };
//! let sweep = Sweep::new(definition)?;
//! let (rows, rest) = Store::open(&path)?;
//! let points: Vec<_> = sweep.points.iter().collect();
//! let todo = missing(&sweep, &points, &store::by_key(rest), &[]);
//! run(&sweep, &todo, &Around { store: &rows, cost: None, estimate: None, done: &|| {} })?;
//!
//! let rows = store::by_key(store::read(&path)?);
//! let table = Table::new(&sweep, &rows);
//! assert_eq!((table.rows.len(), table.machines.len()), (12, 12));
//! let quickest = table.best(&sweep.objectives[0]).expect("all of them were drawn");
//! assert_eq!(quickest.row()["keys"]["interpolator.adders"], 4);
//! # Ok(())
//! # }
//! ```

pub mod definition;
pub mod axis;
pub mod shading;
pub mod subject;
pub mod objective;
pub mod judge;
pub mod require;
pub mod point;
pub mod space;
pub mod grid;
pub mod equation;
pub mod shared;
pub mod apart;
pub mod row;
pub mod store;
pub mod check;
pub mod evaluate;
pub mod front;
pub mod table;
pub mod search;
pub mod csv;

pub use definition::{Definition, Sample};
pub use evaluate::run;
pub use grid::Sweep;
pub use judge::Judge;
pub use objective::Objective;
pub use point::Point;
pub use require::Requirement;
pub use search::Hunt;
pub use store::Store;
