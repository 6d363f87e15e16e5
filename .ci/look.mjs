// Looks at what examples wrote: pages in headless Chromium, motions by Khronos' validator of glTF.
//   node look.mjs PATH-OF-CHROMIUM FOLDER-OF-PICTURES FILE..
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { basename, resolve } from "node:path";
import { createRequire } from "node:module";

// Packages stand where the program is started.
const require = createRequire(resolve("package.json"));
const { chromium } = require("playwright-core");
const validator = require("gltf-validator");
const [executablePath, pictures, ...files] = process.argv.slice(2);
const WINDOWS = {
  light: { viewport: { width: 1200, height: 900 }, colorScheme: "light" },
  dark: { viewport: { width: 1200, height: 900 }, colorScheme: "dark" },
  phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true },
};

// How many colours a picture has, how bright its corner is, and what part of it is of another colour than that.
async function seen(browser, png) {
  const page = await browser.newPage();
  const found = await page.evaluate(async (bytes) => {
    const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), pen = canvas.getContext("2d");
    pen.drawImage(bitmap, 0, 0);
    const { data } = pen.getImageData(0, 0, bitmap.width, bitmap.height);
    const pixels = new Uint32Array(data.buffer), corner = 20 * bitmap.width + 20;
    const other = pixels.filter((pixel) => pixel !== pixels[corner]).length;
    return { colours: new Set(pixels).size, corner: data[4 * corner], part: other / pixels.length };
  }, [...png]);
  await page.close();
  return found;
}

async function look(browser, file, name, options) {
  const context = await browser.newContext(options), page = await context.newPage(), said = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(error.message));
  page.on("request", (request) => request.url().startsWith("file:") || said.push("asks for " + request.url()));
  await page.goto("file://" + resolve(file));
  const now = async () => Number(await page.inputValue("#time"));
  const scene = () => page.locator("#scene").screenshot();
  const first = await scene();
  assert.equal(await now(), 0);
  await page.click("#play");
  await page.waitForFunction(() => Number(document.getElementById("time").value) > 0.05, null, { timeout: 60000 });
  await page.click("#play");
  const at = await now(), later = await scene();
  assert.ok(at > 0 && at < 1 && !first.equals(later), "it moves");
  await page.keyboard.press("End");
  assert.equal(await now(), 1);
  await page.keyboard.press("ArrowLeft");
  assert.ok((await now()) < 1, "one output back");
  await page.keyboard.press("Home");
  assert.equal(await now(), 0);
  assert.ok((await scene()).equals(first), "the start again");
  const { colours, corner, part } = await seen(browser, first);
  assert.ok(colours > 20 && part > 0.01 && part < 0.9, `${colours} colours, ${part} of the scene is a body`);
  assert.equal(corner < 128, name === "dark", "light or dark");
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= options.viewport.width, `as wide as the window, not ${width}`);
  assert.ok((await page.locator("math").count()) > 1, "formulas");
  await page.screenshot({ path: `${pictures}/${basename(file, ".html")}_${name}.png`, fullPage: true });
  assert.deepEqual(said, []);
  await context.close();
  console.log(`${file}, ${name}: plays, ${colours} colours, ${(100 * part).toFixed(1)} percent of the scene is a body`);
}

assert.ok(files.some((file) => file.endsWith(".html")) && files.some((file) => file.endsWith(".glb")));
const args = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await chromium.launch({ executablePath, args });
for (const file of files) {
  if (file.endsWith(".html")) {
    for (const [name, options] of Object.entries(WINDOWS)) await look(browser, file, name, options);
  } else {
    const { issues, info } = await validator.validateBytes(new Uint8Array(await readFile(file)));
    assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
    assert.equal(info.animationCount, 1);
    console.log(`${file}: valid, ${info.totalVertexCount} vertices, ${info.totalTriangleCount} triangles`);
  }
}
await browser.close();
