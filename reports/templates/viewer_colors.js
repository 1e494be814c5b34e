// From linear values to what the screen shows.
const notFinite = [255, 0, 255];  // a colour renders hardly have

function encoded(linear) {
  if (linear <= 0) return 0;
  if (linear >= 1) return 255;
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
}

function displayedImage(rgb, width, height, stops) {
  const out = new ImageData(width, height), scale = 2 ** stops;
  for (let i = 0; i < width * height; ++i) {
    const [r, g, b] = [rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]];
    const finite = Number.isFinite(r + g + b);
    out.data[4 * i] = finite ? encoded(scale * r) : notFinite[0];
    out.data[4 * i + 1] = finite ? encoded(scale * g) : notFinite[1];
    out.data[4 * i + 2] = finite ? encoded(scale * b) : notFinite[2];
    out.data[4 * i + 3] = 255;
  }
  return out;
}

// The error that relMSE squares and averages, with its sign: (x - r) / sqrt(r² + 0.01), mean over the channels.
function signedError(test, reference, i) {
  let sum = 0;
  for (let k = 3 * i; k < 3 * i + 3; ++k) sum += (test[k] - reference[k]) / Math.sqrt(reference[k] ** 2 + 0.01);
  return sum / 3;
}

// Blue is too dark, orange too bright, grey is right: told apart by colour-blind readers, and by lightness from grey.
const tooDark = [[236, 236, 236], [134, 178, 217], [33, 102, 172], [5, 30, 75]];
const tooBright = [[236, 236, 236], [241, 163, 64], [179, 88, 6], [80, 35, 4]];

function errorColor(error) {
  if (!Number.isFinite(error)) return notFinite;
  const ramp = error < 0 ? tooDark : tooBright;
  const at = Math.min(Math.abs(error), 1) * (ramp.length - 1);
  const i = Math.min(Math.floor(at), ramp.length - 2);
  return ramp[i].map((low, c) => low + (at - i) * (ramp[i + 1][c] - low));
}

function errorImage(test, reference, width, height, stops) {
  const out = new ImageData(width, height), gain = 2 ** stops;
  for (let i = 0; i < width * height; ++i) {
    const [r, g, b] = errorColor(gain * signedError(test, reference, i));
    out.data.set([r, g, b, 255], 4 * i);
  }
  return out;
}
