//! What `edgewalk raster` writes, band by band as it is drawn: the arrays, the picture, the report.

use crate::engine::Raster;
use anyhow::{Context, Result, bail};
use edgewalk_files::{Array, Png, Staging};
use edgewalk_host::extra::{self, Values};
use edgewalk_judge::report::Report;
use edgewalk_machine::Plan;

/// Files that fill from the top.
struct Files {
    coverage: Array<u32>,
    writes: Array<u32>,
    id: Array<i32>,
    z: Array<f64>,
    rgb: Array<f64>,
    extra: Vec<ExtraArray>,
    lit: Option<Array<u8>>,
    image: Png,
}

/// A channel of the user's own: f64 of golden's plane, i64 of the machine's outputs.
enum ExtraArray {
    Exact(Array<f64>),
    Stored(Array<i64>),
}

/// A picture on its way out.
pub struct Page<'a, F> {
    out: &'a Staging,
    machine: &'a Plan,
    /// The report of the first band.
    begin: F,
    /// From the first band on.
    begun: Option<(Files, Report)>,
}

impl<'a, F: Fn(&Raster) -> Report> Page<'a, F> {
    /// Of a picture on the machine's screen; `begin` makes the report of its first band.
    pub fn new(out: &'a Staging, machine: &'a Plan, begin: F) -> Self {
        Page { out, machine, begin, begun: None }
    }

    /// The next lines.
    pub fn add(&mut self, band: &Raster) -> Result<()> {
        match &mut self.begun {
            Some((files, report)) => {
                report.add(band);
                files.add(band)
            }
            None => {
                let mut files = Files::create(self.out, self.machine, band)?;
                files.add(band)?;
                self.begun = Some((files, (self.begin)(band)));
                Ok(())
            }
        }
    }

    /// All files to the disk.
    pub fn finish(self) -> Result<Report> {
        let (files, report) = self.begun.context("a picture without lines")?;
        files.finish()?;
        Ok(report)
    }
}

impl Files {
    fn create(out: &Staging, machine: &Plan, first: &Raster) -> Result<Self> {
        let (width, height) = (machine.width, machine.height);
        let shape = &[u64::from(height), u64::from(width)];
        let extra = extra::channels(machine).iter().zip(&first.extra).map(|(channel, values)| {
            let name = format!("{}.npy", channel.name);
            Ok(match values {
                Values::Exact(_) => ExtraArray::Exact(Array::create(out, &name, shape)?),
                Values::Stored(_) => ExtraArray::Stored(Array::create(out, &name, shape)?),
            })
        });
        Ok(Files {
            coverage: Array::create(out, "coverage.npy", shape)?,
            writes: Array::create(out, "writes.npy", shape)?,
            id: Array::create(out, "id.npy", shape)?,
            z: Array::create(out, "z.npy", shape)?,
            rgb: Array::create(out, "rgb.npy", &[shape[0], shape[1], 3])?,
            extra: extra.collect::<Result<_>>()?,
            lit: if first.lit.is_some() { Some(Array::create(out, "lit.npy", shape)?) } else { None },
            image: Png::create(out, "image.png", width, height)?,
        })
    }

    fn add(&mut self, band: &Raster) -> Result<()> {
        self.coverage.extend(&band.coverage)?;
        self.writes.extend(&band.writes)?;
        self.id.extend(&band.id)?;
        self.z.extend(&band.z)?;
        self.rgb.extend(band.rgb.as_flattened())?;
        for (file, values) in self.extra.iter_mut().zip(&band.extra) {
            match (file, values) {
                (ExtraArray::Exact(file), Values::Exact(values)) => file.extend(values)?,
                (ExtraArray::Stored(file), Values::Stored(values)) => file.extend(values)?,
                _ => bail!("bands of one picture by two engines"),
            }
        }
        if let (Some(file), Some(lit)) = (&mut self.lit, &band.lit) {
            file.extend(lit)?;
        }
        self.image.extend_rgb(&band.rgb)
    }

    fn finish(self) -> Result<()> {
        self.coverage.finish()?;
        self.writes.finish()?;
        self.id.finish()?;
        self.z.finish()?;
        self.rgb.finish()?;
        for file in self.extra {
            match file {
                ExtraArray::Exact(file) => file.finish()?,
                ExtraArray::Stored(file) => file.finish()?,
            }
        }
        self.lit.map_or(Ok(()), Array::finish)?;
        self.image.finish()
    }
}
