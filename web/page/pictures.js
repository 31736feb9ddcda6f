// Pictures as the server sends them become bitmaps.

/** Unpacks a QOI of three channels (qoiformat.org). */
export function unpackQoi(bytes, width, height) {
  const pixels = new Uint32Array(width * height), seen = new Uint32Array(64);
  let at = 14, pixel = 0xFF000000, i = 0;
  while (i < pixels.length && at < bytes.length) {
    const tag = bytes[at++];
    if (tag >= 0xC0 && tag < 0xFE) {
      const end = i + (tag & 63) + 1;
      pixels.fill(pixel, i, end);
      i = end;
      continue;
    }
    if (tag === 0xFE) {
      pixel = (bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | 0xFF000000) >>> 0;
      at += 3;
    } else if (tag < 64) {
      pixel = seen[tag];
    } else {
      let red = pixel & 255, green = pixel >> 8 & 255, blue = pixel >> 16 & 255;
      if (tag < 128) {
        red += (tag >> 4 & 3) - 2;
        green += (tag >> 2 & 3) - 2;
        blue += (tag & 3) - 2;
      } else {
        const change = (tag & 63) - 32, others = bytes[at++];
        red += change + (others >> 4) - 8;
        green += change;
        blue += change + (others & 15) - 8;
      }
      pixel = (red & 255 | (green & 255) << 8 | (blue & 255) << 16 | 0xFF000000) >>> 0;
    }
    const place = (pixel & 255) * 3 + (pixel >> 8 & 255) * 5 + (pixel >> 16 & 255) * 7 + 255 * 11 & 63;
    seen[place] = pixel;
    pixels[i++] = pixel;
  }
  return new ImageData(new Uint8ClampedArray(pixels.buffer), width, height);
}

/** The bitmap of a frame. */
export function bitmapOf(frame) {
  if (frame.format === "qoi") return createImageBitmap(unpackQoi(frame.bytes, frame.width, frame.height));
  return createImageBitmap(new Blob([frame.bytes], {type: "image/png"}));
}
