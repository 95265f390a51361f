'use strict';
(() => {
  const root = document.documentElement;
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const setTheme = name => { root.dataset.theme = name; };
  dark.addEventListener('change', e => setTheme(e.matches ? 'dark' : 'light'));
  document.getElementById('theme').addEventListener('click',
    () => setTheme(root.dataset.theme === 'dark' ? 'light' : 'dark'));

  const view = document.getElementById('view');
  if (!view) return;  // no pictures were compared
  const slider = document.getElementById('split');
  const split = () => { view.style.setProperty('--split', slider.value + '%'); };
  slider.addEventListener('input', () => { setMode('slider'); split(); });

  // --- one of: slider, flicker, heat map
  let timer = null;
  const flip = () => { view.dataset.shown = view.dataset.shown === 'expected' ? 'actual' : 'expected'; };
  const buttons = [...document.querySelectorAll('[data-mode-of]')];
  const setMode = mode => {
    view.dataset.mode = mode;
    clearInterval(timer);
    if (mode === 'flicker') { view.dataset.shown = 'expected'; timer = setInterval(flip, 500); }
    for (const b of buttons) b.setAttribute('aria-pressed', b.dataset.modeOf === mode);
  };
  for (const b of buttons) b.addEventListener('click', () => setMode(b.dataset.modeOf));

  // --- the edge follows a drag on the picture
  const drag = e => {
    const box = view.getBoundingClientRect();
    slider.value = Math.min(100, Math.max(0, 100 * (e.clientX - box.left) / box.width));
    split();
  };
  view.addEventListener('pointerdown', e => {
    if (view.dataset.mode !== 'slider') return;
    view.setPointerCapture(e.pointerId);
    drag(e);
  });
  view.addEventListener('pointermove', e => { if (view.dataset.mode === 'slider' && e.buttons & 1) drag(e); });

  // --- the worst tile, each pixel a square
  for (const canvas of document.querySelectorAll('.tiles canvas')) {
    const [x, y, w, h] = canvas.dataset.tile.split(' ').map(Number);
    const picture = view.querySelector('.' + canvas.dataset.of);
    picture.decode().then(() => {
      const pen = canvas.getContext('2d');
      pen.imageSmoothingEnabled = false;
      pen.drawImage(picture, x, y, w, h, 0, 0, canvas.width, canvas.height);
    });
  }
  setMode('slider');
  split();
})();
