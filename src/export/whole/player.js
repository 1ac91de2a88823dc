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
  function at(runs, frame) {
    let low = 0, high = runs.length;
    while (high - low > 1) { const mid = low + high >> 1; if (runs[mid][0] <= frame) low = mid; else high = mid; }
    return runs[low];
  }

  function paintLayer(b, layer, frame) {
    const pose = layer.poses[at(layer.runs, frame)[1]];
    pose.steps ||= steps(pose.kind, pose.values);
    const [, x, y, turn] = at(layer.moves, frame);
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
    if (now() >= clip.duration - 0.01) go(0);
    if (sound) { sound.playbackRate = rate(); sound.preservesPitch = true; sound.play().catch(() => say('The sound cannot be played.')); }
    else { silent.playing = true; silent.since = performance.now(); started(); }
  }
  function pause() {
    until = null;
    if (sound) sound.pause(); else { silent.time = now(); silent.playing = false; stopped(); }
  }
  const toggle = () => isPlaying() ? pause() : play();

  function started() {
    root.classList.add('playing');
    find('play').setAttribute('aria-label', 'Pause');
    requestAnimationFrame(tick);
  }
  function stopped() {
    root.classList.remove('playing');
    find('play').setAttribute('aria-label', 'Play');
    show(now());
  }

  const loops = () => find('loop').getAttribute('aria-pressed') === 'true';
  let sentence = null;
  function tick() {
    if (!isPlaying()) return;
    const time = now();
    if (until !== null && time >= until) { pause(); go(until - 0.001); return; }
    if (until === null && loops() && sentence && time >= sentence.to) { go(sentence.from); }
    if (!sound && time >= clip.duration) { silent.time = clip.duration; silent.playing = false; stopped(); return; }
    show(time);
    requestAnimationFrame(tick);
  }

  const clock = s => Math.floor(s / 60) + ':' + String(Math.floor(s % 60)).padStart(2, '0');
  let lit = null;
  function show(time) {
    const frame = Math.min(clip.frames - 1, Math.floor(time * clip.fps + 1e-6));
    if (frame !== shown) paint(frame);
    find('seek').value = time;
    find('seek').setAttribute('aria-valuetext', clock(time) + ' of ' + clock(clip.duration));
    find('time').value = clock(time) + ' / ' + clock(clip.duration);
    const piece = pieces.findLast(p => p.from <= time + 0.0005) || null;
    const said = piece && time < piece.to ? piece : null;
    if (said !== lit) {
      if (lit) lit.element.classList.remove('lit');
      if (said) said.element.classList.add('lit');
      lit = said;
    }
    const own = (piece || pieces[0] || {}).sentence || null;
    if (own !== sentence && !(loops() && isPlaying() && until === null && sentence)) enter(own);
    if (piece && document.activeElement?.getAttribute('role') !== 'button') rove(piece.element);
  }

  function enter(own) {
    sentence?.element.classList.remove('now');
    sentence = own;
    if (!own) return;
    own.element.classList.add('now');
    const box = own.element.getBoundingClientRect();
    const top = innerWidth < 992 ? document.querySelector('.stage').getBoundingClientRect().bottom : 0;
    if (isPlaying() && (box.bottom > innerHeight || box.top < Math.max(top, 0))) {
      scrollTo({ top: scrollY + box.top - Math.max(top, 0) - 24, behavior: calm.matches ? 'auto' : 'smooth' });
    }
  }

  // One syllable at a time can be reached by tab; arrows go on from there.
  function rove(element) {
    pieces.forEach(p => { p.element.tabIndex = p.element === element ? 0 : -1; });
  }

  const say = text => { find('status').textContent = text; };

  async function open(number) {
    if (clip) { pause(); find('said-' + clips.indexOf(clip)).hidden = true; }
    clip = clips[number];
    sound = find('sound-' + number);
    const script = find('said-' + number);
    script.hidden = false;
    pieces = [];
    for (const p of script.querySelectorAll('p')) {
      const own = [...p.querySelectorAll('span[role=button]')];
      if (!own.length) continue;
      const whole = { element: p, from: +own[0].dataset.from, to: +own[own.length - 1].dataset.to };
      own.forEach(e => pieces.push({ element: e, from: +e.dataset.from, to: +e.dataset.to, sentence: whole }));
    }
    if (pieces.length) rove(pieces[0].element);
    document.querySelectorAll('nav button').forEach((b, i) => b.setAttribute('aria-current', String(i === number)));
    canvas.setAttribute('aria-label', clip.about);
    find('seek').max = clip.duration;
    find('mouth').hidden = !clip.mouth;
    find('loop').hidden = !pieces.length;
    lit = sentence = null; shown = -1; ground = null;
    document.querySelector('.picture').style.aspectRatio = clip.size.join('/');
    if (!clip.layers) {
      try { await unpack(clip); } catch (error) { say('This browser is too old to show the face: ' + error.message); throw error; }
    }
    fit();
    go(0);
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
      const u = Math.min(1, (time - begun) / 260);
      zoom = from + (to - from) * u * u * (3 - 2 * u);
      redraw();
      if (u < 1) requestAnimationFrame(move);
    };
    requestAnimationFrame(move);
  }

  function loop() {
    const on = press(find('loop'));
    say(on ? 'The sentence is repeated' : 'Plays on');
    if (on) enter((pieces.findLast(p => p.from <= now() + 0.0005) || pieces[0] || {}).sentence || null);
  }

  function speed(value) {
    find('speed').value = value;
    const shownRate = +rate().toFixed(2) + '×';
    find('rate').value = shownRate;
    find('speed').setAttribute('aria-valuetext', shownRate);
    if (sound) sound.playbackRate = rate();
    else if (silent.playing) { const time = now(); silent.time = time; silent.since = performance.now(); }
  }

  function reading(value) {
    find('reading').value = value;
    root.classList.toggle('show-pinyin', value === 'pinyin');
    root.classList.toggle('show-zhuyin', value === 'zhuyin');
  }

  // By sentence or by syllable, from where the clip is.
  function step(by, small) {
    if (!pieces.length) { go(now() + by * 2); return; }
    const starts = small ? pieces.map(p => p.from) : [...new Set(pieces.map(p => p.sentence.from))];
    const time = now();
    const at = starts.findLastIndex(s => s <= time + 0.01);
    const target = starts[Math.max(0, Math.min(starts.length - 1, by < 0 && time - starts[at] > 0.5 && !small ? at : at + by))];
    enter((pieces.findLast(p => p.from <= target + 0.0005) || pieces[0]).sentence);
    go(target + 0.001);
  }

  find('play').onclick = find('cover').onclick = toggle;
  find('seek').oninput = e => { until = null; go(+e.target.value); if (loops()) enter((pieces.findLast(p => p.from <= now()) || pieces[0] || {}).sentence || null); };
  find('speed').oninput = e => speed(e.target.value);
  find('speed').onchange = () => say('Speed ' + find('rate').value);
  find('loop').onclick = loop;
  find('mouth').onclick = closeUp;
  find('reading').onchange = e => reading(e.target.value);
  document.querySelectorAll('nav button').forEach((b, i) => { b.onclick = () => open(i); });

  const hear = element => {
    const piece = pieces.find(p => p.element === element);
    if (!piece) return;
    rove(element);
    go(piece.from);
    play(piece.to);
  };
  document.querySelector('.script').addEventListener('click', e => {
    const element = e.target.closest('span[role=button]');
    if (element) hear(element);
  });
  document.querySelectorAll('audio').forEach(a => {
    a.addEventListener('play', () => { if (a === sound) started(); });
    ['pause', 'ended'].forEach(name => a.addEventListener(name, () => { if (a === sound) stopped(); }));
    a.addEventListener('seeked', () => { if (a === sound && a.paused) show(a.currentTime); });
  });

  addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const on = document.activeElement, tag = on?.tagName;
    const piece = on?.getAttribute('role') === 'button' ? pieces.findIndex(p => p.element === on) : -1;
    if (piece >= 0) {
      const to = { ArrowRight: piece + 1, ArrowLeft: piece - 1, Home: 0, End: pieces.length - 1 }[e.key];
      if (to !== undefined && pieces[to]) { rove(pieces[to].element); pieces[to].element.focus(); e.preventDefault(); return; }
      if (e.key === 'Enter' || e.key === ' ') { hear(on); e.preventDefault(); return; }
    }
    if (tag === 'SELECT' || (tag === 'INPUT' && /^(Arrow|Home|End|Page)/.test(e.key)) || (tag === 'BUTTON' && /^( |Enter)$/.test(e.key))) return;
    const act = {
      ' ': toggle, k: toggle, ArrowLeft: () => step(-1, false), ArrowRight: () => step(1, false),
      ',': () => step(-1, true), '.': () => step(1, true), l: () => { if (pieces.length) loop(); },
      m: () => { if (clip.mouth) closeUp(); }, '[': () => speed(rate() - 0.05), ']': () => speed(rate() + 0.05),
      r: () => { const s = find('reading'); reading(s.options[(s.selectedIndex + 1) % s.options.length].value); },
    }[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (act) { act(); e.preventDefault(); }
  });

  new ResizeObserver(() => { if (clip?.layers) fit(); }).observe(canvas);
  await open(0);
  root.dataset.ready = 'yes';
})();
