//! What TERM costs: clocks a pixel by the size of triangles.

use super::{case, plan};
use edgewalk_host::draw;
use edgewalk_machine::Plan;
use edgewalk_model::{Activity, Waits};
use edgewalk_scene::{Frame, PixelTriangle};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Whole machines that draw 300 random triangles of a size at a time: fast Phong with each walk beside Gouraud shading; clocks a pixel, and of
/// these in which a span waited for TERM.
#[test]
fn clocks_a_pixel_by_the_size_of_triangles() {
    let walks = [("term.walk", "register"), ("term.walk", "memory")];
    let machines = walks.map(|walk| plan(&[("shade.kind", "fast-phong"), walk]));
    let plain = plan(&[]);
    let mut random = Pcg64Mcg::seed_from_u64(15);
    let mut rows = Vec::new();
    for (least, most) in [(4.0, 8.0), (8.0, 16.0), (16.0, 32.0), (32.0, 64.0), (64.0, 128.0), (128.0, 300.0)]
    {
        let mut whole: Option<Frame> = None;
        for number in 0..300 {
            let mut one = case(&mut random, number, 1, 10.0);
            let size = random.random_range(least..most);
            let at = [random.random_range(0.0..640.0 - size), random.random_range(0.0..480.0 - size)];
            for vertex in &mut one.triangles[0].0 {
                vertex.x = at[0] + size * random.random::<f64>();
                vertex.y = at[1] + size * random.random::<f64>();
            }
            (one.width, one.height) = (640, 480);
            match &mut whole {
                None => whole = Some(one),
                Some(all) => {
                    let (own, shading) = (one.shading.unwrap(), all.shading.as_mut().unwrap());
                    all.triangles.append(&mut one.triangles);
                    shading.triangles.push(PixelTriangle { material: 0, ..own.triangles[0] });
                }
            }
        }
        let mut frame = whole.unwrap();
        // One surface, so that no tables are fetched between.
        for vertex in frame.triangles.iter_mut().flat_map(|triangle| &mut triangle.0) {
            (vertex.r, vertex.g, vertex.b) = (0.5, 0.5, 0.5);
        }
        let clocks = |machine: &Plan, frame: &Frame| {
            let raster = draw::fast(frame, machine, Waits::Never).unwrap();
            let pixels: u32 = raster.coverage.iter().sum();
            let cycles = raster.cycles.unwrap();
            (f64::from(pixels), cycles.total as f64, cycles.spent(Activity::Term) as f64)
        };
        let (pixels, alone, _) = clocks(&plain, &Frame { shading: None, ..frame.clone() });
        let [register, memory] = machines.each_ref().map(|machine| clocks(machine, &frame));
        assert!(register.0 == pixels && memory.0 == pixels, "the same triangles");
        println!(
            "{least}-{most} px: {:.1} pixels a triangle; clocks a pixel {:.2} without, {:.2} register ({:.2} for TERM), {:.2} memory ({:.2} for TERM)",
            pixels / 300.0,
            alone / pixels,
            register.1 / pixels,
            register.2 / pixels,
            memory.1 / pixels,
            memory.2 / pixels,
        );
        assert!(alone <= register.1 && register.1 <= memory.1);
        rows.push([alone, register.1, memory.1].map(|cycles| cycles / pixels));
    }
    // Large triangles: hardly more than a clock a pixel with either walk.
    let last = rows[rows.len() - 1];
    assert!(rows.len() == 6 && last[1] < 1.1 && last[2] < 1.2, "{rows:?}");
}
