//! The report is one file that needs nothing else.

use crate::support::{colors, run};
use base64::prelude::{BASE64_STANDARD, Engine as _};

#[test]
fn the_report_names_no_network_and_reads_without_scripts() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = [
        "sweep",
        "sphere",
        "--vary",
        "formats.z_fraction=6,10",
        "--vary",
        "interpolator.adders=1,4",
        "--out",
        "s",
        "--quiet",
    ];
    assert_eq!(run(folder.path(), &sweep), (Some(0), String::new()));
    let page = std::fs::read_to_string(folder.path().join("s/report.html")).unwrap();
    for network in ["http:", "https:", "src=\"/", "@import", "url(http", "<link"] {
        assert!(!page.contains(network), "{network}");
    }
    assert!(
        !page.contains('@') || page.matches("@media").count() == page.matches('@').count(),
        "a place was not filled"
    );
    let still = page.split("<script").next().unwrap();
    for part in
        ["<svg", "◆", "best_cycles.toml", "The first front", "data:image/png;base64,", "interpolator.adders"]
    {
        assert!(still.contains(part), "{part} needs a script");
    }
}

#[test]
fn the_pictures_of_the_report_are_those_of_render() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "sphere", "--vary", "formats.z_fraction=6", "--out", "s", "--quiet"];
    assert_eq!(run(folder.path(), &sweep), (Some(0), String::new()));
    let render = ["render", "sphere", "--set", "formats.z_fraction=6", "--out", "r", "--quiet"];
    assert_eq!(run(folder.path(), &render), (Some(0), String::new()));
    let page = std::fs::read_to_string(folder.path().join("s/report.html")).unwrap();
    let embedded = page.split("data:image/png;base64,").skip(1);
    let files = embedded.map(|rest| BASE64_STANDARD.decode(rest.split('"').next().unwrap()).unwrap());
    let pictures: Vec<_> = files
        .map(|bytes| {
            let file = folder.path().join("embedded.png");
            std::fs::write(&file, bytes).unwrap();
            colors(&file)
        })
        .collect();
    let of_render = ["image.png", "z_error.png", "color_error.png"];
    assert_eq!(pictures.len(), of_render.len(), "one machine is the best in everything");
    for (picture, name) in pictures.iter().zip(of_render) {
        assert!(*picture == colors(&folder.path().join("r").join(name)), "{name}");
    }
}
