//! A page in headless Chromium, its network cut, used by a script.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Collects what goes wrong before the page's own script runs.
const BEFORE: &str = "<script>window.faults = []; addEventListener('error', (e) => faults.push(e.message)); \
                      addEventListener('unhandledrejection', (e) => faults.push(String(e.reason)));</script>";

/// Opens the page as it would be with `script` at its end, the body of an async function, and gives what that returns. Fails
/// where the page or the script fails.
pub fn used(page: &Path, script: &str) -> Value {
    let after = format!(
        "<script>(async () => {{ const seen = await (async () => {{ {script} }})();
        const result = document.createElement('pre'); result.id = 'result';
        result.textContent = Array.from(new TextEncoder().encode(JSON.stringify([faults, seen])), (b) => b.toString(16).padStart(2, '0')).join('');
        document.body.append(result); }})();</script>"
    );
    let text = std::fs::read_to_string(page).unwrap();
    let text =
        text.replacen("<head>", &format!("<head>{BEFORE}"), 1).replacen("</body>", &(after + "</body>"), 1);
    let home = tempfile::tempdir().unwrap();
    let opened = home.path().join("opened.html");
    std::fs::write(&opened, text).unwrap();
    let output = Command::new("chromium-headless-shell")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--dump-dom"])
        .args(["--proxy-server=127.0.0.1:9", "--virtual-time-budget=20000", "--timeout=60000"])
        .arg(format!("--user-data-dir={}", home.path().join("profile").display()))
        .arg(format!("file://{}", opened.display()))
        .output()
        .expect("tests/run installs it: apt-get install chromium-headless-shell");
    let dom = String::from_utf8(output.stdout).unwrap();
    let result = dom.split("<pre id=\"result\">").nth(1).and_then(|rest| rest.split('<').next());
    let result = result.unwrap_or_else(|| panic!("the script did not end: {dom:.2000}"));
    let bytes: Vec<u8> =
        (0..result.len()).step_by(2).map(|at| u8::from_str_radix(&result[at..at + 2], 16).unwrap()).collect();
    let [faults, seen]: [Value; 2] = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(faults, serde_json::json!([]));
    seen
}
