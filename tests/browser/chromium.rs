//! Chromium without a window, led over its pipe (the DevTools protocol: messages of JSON that end with a zero byte).

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Longest wait for an answer.
const PATIENCE: Duration = Duration::from_secs(20);

/// Ours, with a profile of its own that goes with it.
pub struct Chromium {
    child: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    events: VecDeque<Value>,
    last: u64,
    _profile: tempfile::TempDir,
}

/// A tab of it.
pub struct Tab<'a> {
    browser: &'a mut Chromium,
    session: String,
    /// The addresses that were asked for, and what went wrong in the page.
    pub requests: Vec<String>,
    pub faults: Vec<String>,
}

impl Chromium {
    /// Where it is: `LIANPU_CHROMIUM`, or in the path. Says in a line that it is not there.
    fn program() -> Option<PathBuf> {
        if let Some(own) = std::env::var_os("LIANPU_CHROMIUM") {
            return Some(own.into());
        }
        let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
        let path = std::env::var_os("PATH").unwrap_or_default();
        let found = std::env::split_paths(&path).flat_map(|f| names.map(|n| f.join(n))).find(|f| f.is_file());
        if found.is_none() {
            println!("no Chromium in the path or in LIANPU_CHROMIUM: nothing was tried in a browser");
        }
        found
    }

    /// Starts it; none where there is none.
    pub fn start() -> Option<Self> {
        let program = Self::program()?;
        let profile = tempfile::tempdir().unwrap();
        // The pipe is read from descriptor 3 and written to 4: a shell puts them there.
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >/dev/null 2>/dev/null"])
            .arg(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--mute-audio", "--no-first-run"])
            .args(["--force-color-profile=srgb", "--hide-scrollbars", "--remote-debugging-pipe"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let to = child.stdin.take().unwrap();
        let mut reader = BufReader::new(child.stdout.take().unwrap());
        let (send, from) = channel();
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while reader.read_until(0, &mut message).is_ok_and(|n| n > 0) {
                message.pop();
                if serde_json::from_slice(&message).is_ok_and(|m| send.send(m).is_err()) {
                    return;
                }
                message.clear();
            }
        });
        Some(Self { child, to, from, events: VecDeque::new(), last: 0, _profile: profile })
    }

    fn call(&mut self, session: Option<&str>, method: &str, params: &Value) -> Value {
        self.last += 1;
        let mut message = json!({ "id": self.last, "method": method, "params": params });
        if let Some(session) = session {
            message["sessionId"] = json!(session);
        }
        self.to.write_all(format!("{message}\0").as_bytes()).unwrap();
        let until = Instant::now() + PATIENCE;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let Ok(answer) = self.from.recv_timeout(left) else { panic!("no answer to {method}") };
            if answer["id"] == json!(self.last) {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.events.push_back(answer);
        }
    }

    /// Opens a file in a tab of some size and waits until it is loaded.
    pub fn open(&mut self, file: &Path, [width, height]: [u32; 2]) -> Tab<'_> {
        let target = self.call(None, "Target.createTarget", &json!({ "url": "about:blank" }));
        let params = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = self.call(None, "Target.attachToTarget", &params);
        let session = attached["sessionId"].as_str().unwrap().to_owned();
        let mut tab = Tab { browser: self, session, requests: Vec::new(), faults: Vec::new() };
        for domain in ["Page", "Runtime", "Log", "Network", "Accessibility"] {
            tab.call(&format!("{domain}.enable"), &json!({}));
        }
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        tab.call("Emulation.setDeviceMetricsOverride", &size);
        tab.call("Page.navigate", &json!({ "url": format!("file://{}", address(file)) }));
        tab.wait("document.readyState === 'complete' && location.protocol === 'file:'");
        tab
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        let _ = self.to.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        // Its own end leaves no helpers behind.
        for _ in 0..60 {
            if self.child.try_wait().is_ok_and(|status| status.is_some()) {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Tab<'_> {
    fn call(&mut self, method: &str, params: &Value) -> Value {
        let result = self.browser.call(Some(&self.session), method, params);
        for event in self.browser.events.drain(..).filter(|e| e["sessionId"] == json!(self.session)) {
            let params = &event["params"];
            match event["method"].as_str() {
                Some("Network.requestWillBeSent") => {
                    self.requests.push(params["request"]["url"].as_str().unwrap_or_default().chars().take(200).collect());
                }
                Some("Runtime.exceptionThrown") => self.faults.push(params["exceptionDetails"].to_string()),
                Some("Log.entryAdded") => self.faults.push(params["entry"]["text"].to_string()),
                _ => {}
            }
        }
        result
    }

    /// The value of an expression; a promise is waited for. It counts as something that the reader did.
    pub fn eval(&mut self, expression: &str) -> Value {
        let params = json!({
            "expression": expression, "awaitPromise": true, "returnByValue": true, "userGesture": true,
        });
        let result = self.call("Runtime.evaluate", &params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, expression: &str) {
        let until = Instant::now() + PATIENCE;
        while self.eval(expression) != json!(true) {
            assert!(Instant::now() < until, "never true: {expression}; {:?}", self.faults);
            std::thread::sleep(Duration::from_millis(30));
        }
    }

    /// Presses a key: a character, or a name such as `ArrowRight`.
    pub fn key(&mut self, key: &str) {
        let code = match key {
            "ArrowLeft" => 37,
            "ArrowRight" => 39,
            "Tab" => 9,
            _ => u32::from(key.to_uppercase().chars().next().unwrap()),
        };
        let mut down = json!({ "type": "rawKeyDown", "key": key, "windowsVirtualKeyCode": code });
        if key.chars().count() == 1 {
            (down["type"], down["text"]) = (json!("keyDown"), json!(key));
        }
        self.call("Input.dispatchKeyEvent", &down);
        let up = json!({ "type": "keyUp", "key": key, "windowsVirtualKeyCode": code });
        self.call("Input.dispatchKeyEvent", &up);
    }

    /// What a reader of the screen is told: role and name of all that is in the page.
    pub fn told(&mut self) -> Vec<(String, String)> {
        let tree = self.call("Accessibility.getFullAXTree", &json!({}));
        let text = |v: &Value| v["value"].as_str().unwrap_or_default().to_owned();
        let nodes = tree["nodes"].as_array().unwrap().iter().filter(|n| n["ignored"] != json!(true));
        nodes.map(|n| (text(&n["role"]), text(&n["name"]))).collect()
    }

    /// Whether motion is to be little, and colours dark.
    pub fn prefer(&mut self, feature: &str, value: &str) {
        let params = json!({ "features": [{ "name": feature, "value": value }] });
        self.call("Emulation.setEmulatedMedia", &params);
    }

    /// What is seen, as PNG.
    pub fn seen(&mut self) -> Vec<u8> {
        self.eval("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(() => r(true))))");
        let shot = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        from_base64(shot["data"].as_str().unwrap())
    }
}

/// A path as an address.
fn address(file: &Path) -> String {
    let plain = |b: &u8| b.is_ascii_alphanumeric() || b"/-_.".contains(b);
    let bytes = file.to_str().unwrap().as_bytes();
    bytes.iter().map(|b| if plain(b) { char::from(*b).to_string() } else { format!("%{b:02X}") }).collect()
}

/// The bytes of Base64, without a check.
pub fn from_base64(text: &str) -> Vec<u8> {
    let value = |b: u8| match b {
        b'A'..=b'Z' => b - b'A',
        b'a'..=b'z' => b - b'a' + 26,
        b'0'..=b'9' => b - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for four in text.trim_end_matches('=').as_bytes().chunks(4) {
        let bits = four.iter().fold(0_u32, |bits, b| bits << 6 | u32::from(value(*b))) << (6 * (4 - four.len()));
        bytes.extend_from_slice(&bits.to_be_bytes()[1..four.len()]);
    }
    bytes
}
