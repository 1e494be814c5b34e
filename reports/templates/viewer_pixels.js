// Pixel values as reports/page/pixel_data.h packs them.
const codeOfOne = 20 * 256 + 1, codeOfInfinity = 32766, codeOfNan = 32767;

function valueOfCode(code) {
  const size = Math.abs(code);
  if (size === 0) return 0;
  if (size === codeOfNan) return NaN;
  const value = size === codeOfInfinity ? Infinity : 2 ** ((size - codeOfOne) / 256);
  return code < 0 ? -value : value;
}

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new DecompressionStream("deflate"), writer = stream.writable.getWriter();
  writer.write(bytes);
  writer.close();
  return new Uint8Array(await new Response(stream.readable).arrayBuffer());
}

// Linear RGB, row 0 on top.
async function unpackedPixels(base64) {
  const planes = await inflated(base64);
  const pixels = planes.length / 6;
  const rgb = new Float32Array(3 * pixels);
  const left = [0, 0, 0];
  for (let i = 0; i < pixels; ++i) {
    for (let k = 0; k < 3; ++k) {
      const folded = planes[2 * k * pixels + i] | planes[(2 * k + 1) * pixels + i] << 8;
      left[k] += folded & 1 ? -(folded + 1) / 2 : folded / 2;
    }
    const code = [left[0] + left[1], left[0], left[0] + left[2]];
    for (let k = 0; k < 3; ++k) rgb[3 * i + k] = valueOfCode(code[k] << 16 >> 16);
  }
  return rgb;
}

// FLIP as reports/view/flip_values.h packs it.
async function unpackedFlip(base64) {
  const bytes = await inflated(base64);
  let left = 0;
  return Float32Array.from(bytes, (difference) => (left = left + difference & 255) / 255);
}
