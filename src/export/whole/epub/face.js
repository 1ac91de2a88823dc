// The face of the chapter goes with its sound: with the player under it, or with what the reader reads aloud.
addEventListener('load', () => {
  const face = document.getElementById('face'), sound = document.getElementById('sound');
  let svg;
  try { svg = face.contentDocument && face.contentDocument.documentElement; } catch { return; }
  if (!svg || !svg.setCurrentTime) return;
  const hold = time => { svg.pauseAnimations(); svg.setCurrentTime(time); };
  hold(0);
  if (sound) {
    const tie = () => {
      if (sound.paused) return;
      if (Math.abs(svg.getCurrentTime() - sound.currentTime) > 0.02) svg.setCurrentTime(sound.currentTime);
      requestAnimationFrame(tie);
    };
    sound.addEventListener('playing', () => { svg.setCurrentTime(sound.currentTime); svg.unpauseAnimations(); tie(); });
    for (const name of ['pause', 'ended', 'seeking']) sound.addEventListener(name, () => hold(sound.currentTime));
  }
  // A reader marks what it reads by a class: the face goes on from there until nothing is marked any more.
  let stop;
  new MutationObserver(changes => {
    const read = document.querySelector('.-epub-media-overlay-active[data-from]');
    clearTimeout(stop);
    if (read) {
      if (changes.some(c => c.target === read)) svg.setCurrentTime(+read.dataset.from);
      svg.unpauseAnimations();
    } else {
      stop = setTimeout(() => svg.pauseAnimations(), 300);
    }
  }).observe(document.body, { subtree: true, attributes: true, attributeFilter: ['class'] });
});
