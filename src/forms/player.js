'use strict';
(async () => {
  const find = id => document.getElementById(id);
  const root = document.documentElement;
  const clips = JSON.parse(find('data').textContent);
  const canvas = document.querySelector('canvas');
  const brush = canvas.getContext('2d');
  const calm = matchMedia('(prefers-reduced-motion: reduce)');

  // The numbers of a clip's parts: see `packed.rs`.
  async function unpack(clip) {
    const packed = Uint8Array.from(atob(clip.bytes), c => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    let at = 0;
    const number = () => {
      let value = 0, factor = 1, byte;
      do { byte = bytes[at++]; value += (byte & 127) * factor; factor *= 128; } while (byte > 127);
      return value % 2 ? -(value + 1) / 2 : value / 2;
    };
    const count = marks => marks.reduce((sum, m) => sum + size(m), 0);
    const points = verbs => 2 * [...verbs].reduce((n, v) => n + ({ M: 1, L: 1, Q: 2, C: 3 }[v] || 0), 0);
    const size = m => [() => 1 + points(m[2]), () => 5, () => 4, () => 0, () => points(m[1]) + count(m[2])][m[0]]();
    clip.layers = [];
    for (const sheet of clip.sheets) {
      const moves = [];
      const last = [0, 0, 0, 0];
      for (let n = number(); n > 0; n--) moves.push(last.map((_, i) => last[i] += number()));
      for (const part of sheet) {
        const before = part.kinds.map(kind => new Int32Array(count(kind)));
        const poses = [];
        for (let n = number(); n > 0; n--) {
          const kind = number();
          const values = before[kind].map(v => v + number());
          before[kind] = values;
          poses.push({ kind: part.kinds[kind], values });
        }
        const runs = [];
        let frame = 0, pose = 0;
        for (let n = number(); n > 0; n--) runs.push([frame += number(), pose += number()]);
        clip.layers.push({ moves, poses, runs });
      }
    }
    delete clip.bytes;
  }

  const colour = (hex, alpha) => alpha === 255 ? hex : hex + (256 + alpha).toString(16).slice(1);

  // A pose as a list of steps that draw it; made when it is first seen.
  function steps(kind, values) {
    let i = 0;
    const path = verbs => {
      const made = new Path2D();
      let x = 0, y = 0;
      const p = () => [x += values[i++], y += values[i++]];
      for (const verb of verbs) {
        if (verb === 'M') made.moveTo(...p());
        else if (verb === 'L') made.lineTo(...p());
        else if (verb === 'Q') made.quadraticCurveTo(...p(), ...p());
        else if (verb === 'C') made.bezierCurveTo(...p(), ...p(), ...p());
        else made.closePath();
      }
      return made;
    };
    const one = m => {
      if (m[0] === 0) {
        const fill = colour(m[1], values[i++]), shape = path(m[2]);
        return b => { b.fillStyle = fill; b.fill(shape); };
      }
      if (m[0] === 1) {
        const alpha = values[i++], [x, y, rx, ry] = [values[i++], values[i++], values[i++], values[i++]];
        return b => {
          const fade = b.createRadialGradient(0, 0, 0, 0, 0, 1);
          fade.addColorStop(0, colour(m[1], alpha));
          fade.addColorStop(1, colour(m[1], 0));
          b.save(); b.translate(x, y); b.scale(rx, ry); b.fillStyle = fade;
          b.beginPath(); b.arc(0, 0, 1, 0, 7); b.fill(); b.restore();
        };
      }
      if (m[0] === 2) {
        const fill = colour(m[1], values[i++]), [x, y, size] = [values[i++], values[i++], values[i++]];
        return b => { b.fillStyle = fill; b.font = size + 'px Inter, sans-serif'; b.textAlign = m[2]; b.fillText(m[3], x, y); };
      }
      if (m[0] === 3) {
        const image = new Image();
        image.onload = () => redraw();
        image.src = m[1];
        return b => { if (image.complete) { b.save(); b.transform(...m[2]); b.drawImage(image, 0, 0); b.restore(); } };
      }
      const clip = path(m[1]), inside = m[2].map(one);
      return b => { b.save(); b.clip(clip); inside.forEach(step => step(b)); b.restore(); };
    };
    return kind.map(one);
  }

  // What holds at a frame.
  function held(runs, frame) {
    let low = 0, high = runs.length;
    while (high - low > 1) { const mid = low + high >> 1; if (runs[mid][0] <= frame) low = mid; else high = mid; }
    return runs[low];
  }

  function paintLayer(b, layer, frame) {
    const pose = layer.poses[held(layer.runs, frame)[1]];
    pose.steps ||= steps(pose.kind, pose.values);
    const [, x, y, turn] = held(layer.moves, frame);
    const moved = x || y || turn;
    if (moved) { b.save(); b.translate(x, y); b.rotate(turn * Math.PI / 180000); }
    pose.steps.forEach(step => step(b));
    if (moved) b.restore();
  }

  let clip, sound, pieces = [], shown = -1, zoom = 0, ground = null;
  const isStill = layer => layer.runs.length < 2 && layer.moves.length < 2;

  // From grid to pixels; `zoom` goes from the whole picture, 0, to the mouth alone, 1.
  function place(b) {
    const [w, h] = clip.size, k = canvas.width / w;
    let [x0, y0, x1, y1] = [0, 0, w, h];
    if (zoom > 0 && clip.mouth) {
      const [a, c, d, e] = clip.mouth.map((v, i) => v / 8 + clip.origin[i % 2]);
      const high = Math.max(1.7 * (e - c), 1.7 * (d - a) * h / w), wide = high * w / h;
      const to = [(a + d - wide) / 2, (c + e - high) / 2, (a + d + wide) / 2, (c + e + high) / 2];
      [x0, y0, x1, y1] = [x0, y0, x1, y1].map((v, i) => v + (to[i] - v) * zoom);
    }
    const s = k * w / (x1 - x0);
    b.setTransform(s / 8, 0, 0, s / 8, (clip.origin[0] - x0) * s, (clip.origin[1] - y0) * s);
  }

  // What lies under everything that moves is painted once.
  function paintGround() {
    ground = document.createElement('canvas');
    ground.width = canvas.width; ground.height = canvas.height;
    const b = ground.getContext('2d');
    if (clip.ground) { b.fillStyle = clip.ground; b.fillRect(0, 0, ground.width, ground.height); }
    place(b);
    const first = clip.layers.findIndex(layer => !isStill(layer));
    clip.first = first < 0 ? clip.layers.length : first;
    clip.layers.slice(0, clip.first).forEach(layer => paintLayer(b, layer, 0));
  }

  function paint(frame) {
    if (!clip.layers) return;
    shown = frame;
    canvas.dataset.frame = frame;
    if (!ground) paintGround();
    brush.setTransform(1, 0, 0, 1, 0, 0);
    brush.clearRect(0, 0, canvas.width, canvas.height);
    brush.drawImage(ground, 0, 0);
    place(brush);
    clip.layers.slice(clip.first).forEach(layer => paintLayer(brush, layer, frame));
  }

  const redraw = () => { ground = null; paint(Math.max(shown, 0)); };

  // The clock is the sound; without one it is the page's own.
  const silent = { time: 0, since: 0, playing: false };
  const rate = () => +find('speed').value;
  const now = () => sound ? sound.currentTime
    : Math.min(clip.duration, silent.time + (silent.playing ? (performance.now() - silent.since) / 1000 * rate() : 0));
  const isPlaying = () => sound ? !sound.paused : silent.playing;

  function go(time) {
    time = Math.max(0, Math.min(clip.duration, time));
    if (sound) sound.currentTime = time; else { silent.time = time; silent.since = performance.now(); }
    show(time);
  }

  let until = null;
  function play(to = null) {
    until = to;
    root.classList.add('begun');
    if (to === null && now() >= clip.duration - 0.01) go(loops() && sentence ? sentence.from : 0);
    if (!sound) { silent.playing = true; silent.since = performance.now(); started(); return; }
    const own = sound;
    own.playbackRate = rate();
    own.preservesPitch = true;
    own.play().then(() => notice(''), error => {
      if (own !== sound || error.name === 'AbortError') return;
      if (error.name === 'NotAllowedError') notice('The browser holds the sound back. Press play once more.');
      else mute(true);
    });
  }
  function pause() {
    until = null;
    if (sound) sound.pause(); else { silent.time = now(); silent.playing = false; stopped(); }
  }
  const toggle = () => isPlaying() ? pause() : play();

  // Where the sound cannot be played the face still goes, by the page's clock.
  function mute(playing) {
    const time = sound?.currentTime || 0;
    clip.mute = true;
    sound = null;
    silent.time = time;
    silent.playing = false;
    notice('This browser cannot play the sound of this clip. The face moves without it.');
    if (playing) play(until); else stopped();
  }

  function started() {
    root.classList.add('playing');
    find('play').setAttribute('aria-label', 'Pause');
    requestAnimationFrame(tick);
  }
  function stopped() {
    root.classList.remove('playing');
    find('play').setAttribute('aria-label', 'Play');
    show(now());
    spoken();
  }

  const loops = () => find('loop').getAttribute('aria-pressed') === 'true';
  let sentence = null;

  // Stops or turns back where it should; whether it goes on.
  function goesOn() {
    if (!isPlaying()) return false;
    const time = now();
    if (until !== null && time >= until) { const end = until; pause(); go(end - 0.001); return false; }
    if (until === null && loops() && sentence && time >= sentence.end) go(sentence.begin);
    if (!sound && time >= clip.duration) { ended(); return isPlaying(); }
    return true;
  }
  function ended() {
    if (!sound) { silent.time = clip.duration; silent.playing = false; }
    if (until === null && loops() && sentence) { go(sentence.begin); play(); } else { until = null; stopped(); }
  }
  function tick() {
    if (!goesOn()) return;
    // What is painted now is seen at the next refresh of the screen, a sixtieth of a second from now.
    show(now(), rate() / 60);
    requestAnimationFrame(tick);
  }

  const clock = s => Math.floor(s / 60) + ':' + String(Math.floor(s % 60)).padStart(2, '0');
  const spoken = () => find('seek').setAttribute('aria-valuetext', clock(now()) + ' of ' + clock(clip.duration));
  const at = time => pieces.findLast(p => p.from <= time + 0.0005) || null;
  let lit = null;
  function show(time, ahead = 0) {
    // The nearest frame: neither before the sound nor behind it by more than half of one.
    const frame = Math.max(0, Math.min(clip.frames - 1, Math.round((time + ahead) * clip.fps - 1e-6)));
    if (frame !== shown) paint(frame);
    find('seek').value = time;
    find('time').textContent = clock(time) + ' / ' + clock(clip.duration);
    const piece = at(time), said = piece && time < piece.to ? piece : null;
    if (said !== lit) {
      if (lit) lit.element.classList.remove('lit');
      if (said) said.element.classList.add('lit');
      lit = said;
    }
    const own = (piece || pieces[0] || {}).sentence || null;
    if (own !== sentence && !(loops() && isPlaying() && until === null && sentence)) enter(own);
  }

  // Brings the sentence into view, but for the one a clip is opened at.
  let settled = false;
  function enter(own) {
    sentence?.element.classList.remove('now');
    sentence = own;
    if (!own) return;
    own.element.classList.add('now');
    const box = own.element.getBoundingClientRect(), stage = document.querySelector('.stage').getBoundingClientRect();
    const top = stage.right > box.left ? Math.max(stage.bottom, 0) : 0;
    if (settled && (box.bottom > innerHeight || box.top < top)) {
      scrollTo({ top: scrollY + box.top - top - 24, behavior: calm.matches ? 'auto' : 'smooth' });
    }
  }

  const say = text => { find('status').textContent = text; };
  const notice = text => { if (find('notice').textContent !== text) find('notice').textContent = text; };

  // The sentences of a clip, and a button before each, made when the clip is first seen.
  function read(script) {
    const sentences = [];
    for (const p of script.querySelectorAll('p')) {
      const own = [...p.querySelectorAll('[data-from]')];
      if (!own.length) continue;
      const whole = { element: p, from: +own[0].dataset.from, to: +own[own.length - 1].dataset.to };
      whole.pieces = own.map(e => ({ element: e, from: +e.dataset.from, to: +e.dataset.to, sentence: whole }));
      sentences.push(whole);
      if (p.querySelector('.hear')) continue;
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'hear';
      button.title = 'Play this sentence';
      button.setAttribute('aria-label', 'Play sentence ' + sentences.length);
      button.innerHTML = '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M8 5v14l11-7z"/></svg>';
      button.lang = 'en';
      p.prepend(button);
    }
    // Repeated with a breath around it, as far as there is one.
    sentences.forEach((s, i) => {
      s.begin = Math.max(s.from - 0.1, i ? sentences[i - 1].to : 0);
      s.end = Math.min(s.to + 0.3, i + 1 < sentences.length ? sentences[i + 1].from : clip.duration);
    });
    return sentences.flatMap(s => s.pieces);
  }

  async function open(number) {
    if (clip) { pause(); find('said-' + clips.indexOf(clip)).hidden = true; }
    lit?.element.classList.remove('lit');
    sentence?.element.classList.remove('now');
    settled = false;
    clip = clips[number];
    notice('');
    sound = clip.mute ? null : find('sound-' + number);
    const script = find('said-' + number);
    script.hidden = false;
    pieces = read(script);
    document.querySelectorAll('nav button').forEach((b, i) => b.setAttribute('aria-current', String(i === number)));
    canvas.setAttribute('aria-label', clip.about);
    find('seek').max = clip.duration;
    find('mouth').hidden = !clip.mouth;
    find('loop').hidden = !pieces.length;
    document.querySelector('.of-script').hidden = !pieces.length;
    lit = sentence = null; shown = -1; ground = null;
    document.querySelector('.picture').style.cssText = `--w:${clip.size[0]};--h:${clip.size[1]}`;
    if (!clip.layers) {
      try { await unpack(clip); } catch (error) {
        notice('This browser is too old to show the face.');
        throw error;
      }
    }
    fit();
    go(0);
    spoken();
    settled = true;
    if (sound?.error) mute(false);
  }

  function fit() {
    const box = canvas.getBoundingClientRect(), sharp = Math.min(devicePixelRatio || 1, 3);
    const wide = Math.max(1, Math.round(box.width * sharp));
    const high = Math.max(1, Math.round(wide * clip.size[1] / clip.size[0]));
    if (canvas.width !== wide || canvas.height !== high) { canvas.width = wide; canvas.height = high; }
    redraw();
  }

  function press(button) {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    return on;
  }

  function closeUp() {
    const to = press(find('mouth')) ? 1 : 0;
    say(to ? 'The mouth alone' : 'The whole face');
    if (calm.matches) { zoom = to; redraw(); return; }
    const from = zoom, begun = performance.now();
    const move = time => {
      const u = Math.max(0, Math.min(1, (time - begun) / 260));
      zoom = from + (to - from) * u * u * (3 - 2 * u);
      redraw();
      if (u < 1) requestAnimationFrame(move);
    };
    requestAnimationFrame(move);
  }

  function loop() {
    const on = press(find('loop'));
    say(on ? 'The sentence is repeated' : 'Plays on');
    if (on) { until = null; enter((at(now()) || pieces[0] || {}).sentence || null); }
  }

  function speed(value) {
    const time = now();
    find('speed').value = value;
    const shownRate = +rate().toFixed(2) + '×';
    find('rate').textContent = shownRate;
    find('speed').setAttribute('aria-valuetext', shownRate);
    if (sound) sound.playbackRate = rate(); else { silent.time = time; silent.since = performance.now(); }
  }

  function reading(value) {
    find('reading').value = value;
    root.classList.toggle('show-pinyin', value === 'pinyin');
    root.classList.toggle('show-zhuyin', value === 'zhuyin');
    try { localStorage.setItem('lianpu-reading', value); } catch { /* Nothing is kept. */ }
  }

  // By sentence, from where the clip is.
  function step(by) {
    if (!pieces.length) { go(now() + by * 2); spoken(); return; }
    const starts = [...new Set(pieces.map(p => p.sentence))].map(s => s.from);
    const time = now();
    const from = starts.findLastIndex(s => s <= time + 0.0005);
    const to = by < 0 && from >= 0 && time - starts[from] > 0.5 ? from : from + by;
    const target = starts[Math.max(0, Math.min(starts.length - 1, to))];
    if (until !== null) pause();
    enter(at(target).sentence);
    go(target + 0.001);
    spoken();
  }

  // By syllable; one that is stepped to while nothing plays is said.
  function stepSmall(by) {
    if (!pieces.length) { pause(); go(now() + by / clip.fps); return; }
    const time = now(), from = pieces.findLastIndex(p => p.from <= time + 0.0005);
    const piece = pieces[Math.max(0, Math.min(pieces.length - 1, from + by))];
    if (isPlaying() && until === null) { enter(piece.sentence); go(piece.from + 0.001); } else hear(piece.from, piece.to);
  }

  function hear(from, to) {
    go(from + 0.001);
    play(to);
  }

  find('play').onclick = find('cover').onclick = toggle;
  find('seek').oninput = e => {
    if (until !== null) pause();
    go(+e.target.value);
    spoken();
    if (loops()) enter((at(now()) || pieces[0] || {}).sentence || null);
  };
  find('speed').oninput = e => speed(e.target.value);
  find('loop').onclick = loop;
  find('mouth').onclick = closeUp;
  find('reading').onchange = e => reading(e.target.value);
  document.querySelectorAll('nav button').forEach((b, i) => { b.onclick = () => open(i); });

  document.querySelector('.script').addEventListener('click', e => {
    const element = e.target.closest('[data-from]'), button = e.target.closest('.hear');
    const piece = element ? pieces.find(p => p.element === element)
      : button && pieces.find(p => p.sentence.element === button.parentElement);
    if (!piece) return;
    enter(piece.sentence);
    if (element) hear(piece.from, piece.to);
    else if (loops()) { go(piece.sentence.begin); play(); }
    else hear(piece.sentence.from, piece.sentence.end);
  });
  document.querySelectorAll('audio').forEach(a => {
    a.addEventListener('play', () => { if (a === sound) started(); });
    a.addEventListener('pause', () => { if (a === sound && !a.ended) stopped(); });
    a.addEventListener('ended', () => { if (a === sound) ended(); });
    a.addEventListener('error', () => { if (a === sound) mute(isPlaying()); });
    a.addEventListener('seeked', () => { if (a === sound && a.paused) show(a.currentTime); });
    // A page that is not seen has no frames: it repeats and stops by these.
    a.addEventListener('timeupdate', () => { if (a === sound && document.hidden) goesOn(); });
  });

  addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const tag = document.activeElement?.tagName;
    if (document.activeElement === find('seek')) {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[e.key];
      if (by) { if (until !== null) pause(); go(now() + by); spoken(); e.preventDefault(); return; }
    }
    if (tag === 'SELECT' || (tag === 'INPUT' && /^(Arrow|Home|End|Page)/.test(e.key)) || (tag === 'BUTTON' && /^( |Enter)$/.test(e.key))) return;
    const act = {
      ' ': toggle, k: toggle, ArrowLeft: () => step(-1), ArrowRight: () => step(1),
      ',': () => stepSmall(-1), '.': () => stepSmall(1), l: () => { if (pieces.length) loop(); },
      m: () => { if (clip.mouth) closeUp(); }, '[': () => speed(rate() - 0.05), ']': () => speed(rate() + 0.05),
      r: () => {
        const list = find('reading');
        if (!list.parentElement.hidden) reading(list.options[(list.selectedIndex + 1) % list.options.length].value);
      },
    }[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (act) { act(); e.preventDefault(); }
  });

  try {
    const kept = localStorage.getItem('lianpu-reading');
    if (kept && !find('reading').parentElement.hidden) reading(kept);
  } catch { /* Nothing was kept. */ }
  new ResizeObserver(() => { if (clip?.layers) fit(); }).observe(canvas);
  await open(0);
  root.dataset.ready = 'yes';
})();
