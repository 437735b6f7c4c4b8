//! The report is one file that needs nothing else.

use crate::support::run;

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
