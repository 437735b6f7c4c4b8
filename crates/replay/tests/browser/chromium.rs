//! A headless Chromium, spoken to over its DevTools socket.

use serde_json::{Value, json};
use std::io::{BufRead as _, BufReader};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Message, WebSocket};

/// The program. The tests that run at a time share one, which ends with the last of them.
struct Chromium {
    child: Child,
    _profile: TempDir,
    /// Of its DevTools socket.
    address: String,
}

static RUNNING: Mutex<Weak<Chromium>> = Mutex::new(Weak::new());

impl Chromium {
    fn running() -> Arc<Chromium> {
        let mut running = RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
        running.upgrade().unwrap_or_else(|| {
            let started = Arc::new(Chromium::start());
            *running = Arc::downgrade(&started);
            started
        })
    }

    fn start() -> Chromium {
        let profile = tempfile::tempdir().expect("a folder");
        let child = Command::new("chromium-headless-shell")
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--hide-scrollbars",
                "--remote-debugging-port=0",
            ])
            .args(["--no-first-run", "--disable-extensions", "--force-color-profile=srgb"])
            .arg("--host-resolver-rules=MAP * ~NOTFOUND")
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn();
        let mut child = child.expect("tests/run installs it: apt-get install chromium-headless-shell");
        let lines = BufReader::new(child.stderr.take().expect("piped")).lines();
        let mut lines = lines.map_while(Result::ok);
        let address = lines.find_map(|line| line.strip_prefix("DevTools listening on ").map(str::to_owned));
        let address = address.expect("chromium says where it listens");
        std::thread::spawn(move || lines.for_each(drop));
        Chromium { child, _profile: profile, address }
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // It may be gone already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A page of the browser. It is closed with this value. The pages share cookies and storage, which none of them has.
pub struct Browser {
    _chromium: Arc<Chromium>,
    socket: WebSocket<MaybeTlsStream<TcpStream>>,
    session: String,
    /// The page, for the browser.
    target: Value,
    asked: u64,
    /// Messages of the console, exceptions, entries of the log.
    pub said: Vec<String>,
    /// Addresses that were asked for, but the page itself and what stands in it.
    pub requests: Vec<String>,
}

impl Drop for Browser {
    fn drop(&mut self) {
        let close = json!({ "id": 0, "method": "Target.closeTarget", "params": { "targetId": self.target } });
        // The browser may be gone already.
        let _ = self.socket.send(Message::text(close.to_string()));
        let _ = self.socket.close(None);
    }
}

/// Longest wait for an answer.
const PATIENCE: Duration = Duration::from_secs(120);

impl Browser {
    /// Opens one, off the network.
    pub fn start() -> Browser {
        let chromium = Chromium::running();
        let (socket, _) = tungstenite::connect(&chromium.address).expect("the DevTools socket");
        let mut browser = Browser {
            _chromium: chromium,
            socket,
            session: String::new(),
            target: Value::Null,
            asked: 0,
            said: Vec::new(),
            requests: Vec::new(),
        };
        let target = browser.ask("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        browser.target = target["targetId"].clone();
        let session = browser.ask("Target.attachToTarget", attach);
        browser.session = session["sessionId"].as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.ask(&format!("{domain}.enable"), json!({}));
        }
        let off = json!({ "offline": true, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0 });
        browser.ask("Network.emulateNetworkConditions", off);
        browser
    }

    /// Sends a command and waits for its answer; keeps what is said meanwhile.
    pub fn ask(&mut self, method: &str, parameters: Value) -> Value {
        self.asked += 1;
        let mut command = json!({ "id": self.asked, "method": method, "params": parameters });
        if !self.session.is_empty() {
            command["sessionId"] = json!(self.session);
        }
        self.socket.send(Message::text(command.to_string())).expect("sent");
        let begun = Instant::now();
        loop {
            assert!(begun.elapsed() < PATIENCE, "{method}: no answer");
            let Message::Text(text) = self.socket.read().expect("an answer") else { continue };
            let answer: Value = serde_json::from_str(&text).expect("JSON");
            if answer["id"] == json!(self.asked) {
                assert!(answer.get("error").is_none(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.hear(&answer);
        }
    }

    fn hear(&mut self, event: &Value) {
        match event["method"].as_str() {
            Some("Runtime.consoleAPICalled" | "Runtime.exceptionThrown" | "Log.entryAdded") => {
                self.said.push(event["params"].to_string());
            }
            Some("Network.requestWillBeSent") => {
                let url = event["params"]["request"]["url"].as_str().unwrap_or_default();
                if !["file:", "data:", "blob:", "about:"].iter().any(|own| url.starts_with(own)) {
                    self.requests.push(url.to_owned());
                }
            }
            _ => {}
        }
    }

    /// The value of an expression; a promise is waited for.
    pub fn eval(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.ask("Runtime.evaluate", parameters);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    /// Opens a file and waits until the page is ready or says why it is not; how long that took.
    pub fn open(&mut self, file: &Path, hash: &str) -> Duration {
        let begun = Instant::now();
        let path: String = file.display().to_string().replace('%', "%25").replace(' ', "%20");
        self.ask("Page.navigate", json!({ "url": "about:blank" }));
        self.ask("Page.navigate", json!({ "url": format!("file://{path}{hash}") }));
        loop {
            let state = self.eval("document.body && document.body.className");
            if state.as_str().is_some_and(|state| state.contains("ready") || state.contains("failed")) {
                return begun.elapsed();
            }
            assert!(begun.elapsed() < PATIENCE, "the page does not come up: {:?}", self.said);
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    pub fn size(&mut self, width: u32, height: u32) {
        let parameters = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.ask("Emulation.setDeviceMetricsOverride", parameters);
        self.eval("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
    }

    /// Presses a key as `KeyboardEvent.key` calls it.
    pub fn key(&mut self, key: &str, shift: bool) {
        let text = if key.chars().count() == 1 { key } else { "" };
        let modifiers = if shift { 8 } else { 0 };
        for kind in ["keyDown", "keyUp"] {
            let mut event = json!({ "type": kind, "key": key, "modifiers": modifiers });
            if kind == "keyDown" && !text.is_empty() {
                event["text"] = json!(text);
            }
            self.ask("Input.dispatchKeyEvent", event);
        }
    }

    pub fn click(&mut self, x: f64, y: f64) {
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.ask("Input.dispatchMouseEvent", event);
        }
    }

    /// The page as it looks, PNG.
    pub fn screenshot(&mut self) -> Vec<u8> {
        use base64::Engine as _;
        let shot = self.ask("Page.captureScreenshot", json!({ "format": "png" }));
        let data = shot["data"].as_str().expect("a picture");
        base64::engine::general_purpose::STANDARD.decode(data).expect("base64")
    }

    /// Nothing was said and nothing asked for.
    pub fn is_quiet(&self) {
        assert!(self.said.is_empty(), "the page says {:?}", self.said);
        assert!(self.requests.is_empty(), "the page asks for {:?}", self.requests);
    }
}
