// The face of the chapter goes with its sound: with the player under it, or with what the reader reads aloud.
addEventListener('load', () => {
  const face = document.getElementById('face'), sound = document.getElementById('sound');
  const pieces = [...document.querySelectorAll('[data-from]')];
  let svg = null;
  try { svg = face.contentDocument && face.contentDocument.documentElement; } catch { /* The reader keeps it apart. */ }
  if (svg && !svg.setCurrentTime) svg = null;
  // Half a frame ahead, the frame that is seen is the nearest to what is heard.
  const ahead = +face.dataset.ahead || 0;
  const hold = time => { if (svg) { svg.pauseAnimations(); svg.setCurrentTime(time); } };
  hold(0);
  if (sound) {
    let lit = null;
    const light = piece => {
      if (piece === lit) return;
      if (lit) lit.classList.remove('heard');
      if (piece) piece.classList.add('heard');
      lit = piece;
    };
    const tie = () => {
      if (sound.paused) return;
      const time = sound.currentTime;
      if (svg && Math.abs(svg.getCurrentTime() - time - ahead) > 0.01) svg.setCurrentTime(time + ahead);
      light(pieces.filter(p => +p.dataset.from <= time && time < +p.dataset.to).pop() || null);
      requestAnimationFrame(tie);
    };
    sound.addEventListener('playing', () => { if (svg) svg.unpauseAnimations(); tie(); });
    for (const name of ['pause', 'ended', 'seeking', 'waiting']) {
      sound.addEventListener(name, () => { hold(sound.currentTime); if (name !== 'seeking') light(null); });
    }
  }
  if (!svg) return;
  // A reader marks what it reads by a class: the face goes on from there until nothing is marked any more.
  let stop;
  new MutationObserver(changes => {
    const read = document.querySelector('.-epub-media-overlay-active[data-from]');
    clearTimeout(stop);
    if (read) {
      if (changes.some(c => c.target === read)) svg.setCurrentTime(+read.dataset.from + ahead);
      svg.unpauseAnimations();
    } else if (!sound || sound.paused) {
      stop = setTimeout(() => svg.pauseAnimations(), 300);
    }
  }).observe(document.body, { subtree: true, attributes: true, attributeFilter: ['class'] });
});
