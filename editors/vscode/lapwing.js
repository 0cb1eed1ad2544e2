// What the extension asks of the program `lapwing`. Knows nothing of the editor, so that it can be tried without one.
"use strict";

/** The arguments of each thing that can be done with a script. */
const jobs = {
  check: (script) => ["check", script],
  plan: (script, picture) => ["plan", script, "--svg", picture],
  run: (script, vehicles) => ["run", script, "--sim", vehicles],
};

/** `copter:2`, `copter:1,rover:1@40%`: undefined when it is right, else what is wrong with it. */
function wrongVehicles(spec) {
  const one = /^(copter|plane|rover|boat|sub|px4):[1-9][0-9]{0,2}(@[0-9]{1,3}%)?$/;
  if (spec.split(",").every((part) => one.test(part.trim()))) return undefined;
  return "vehicles are written copter:2 or copter:1,rover:1 (copter, plane, rover, boat, sub, px4)";
}

/** A page that shows a dry run: its picture, which runs no code, and what was said about it. */
function planPage(picture, words) {
  const escaped = words.replace(/[&<>]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);
  const source = picture ? `data:image/svg+xml;base64,${Buffer.from(picture).toString("base64")}` : "";
  return `<!DOCTYPE html>
<html><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<style>body { margin: 1em } img { max-width: 100%; background: #fff } pre { white-space: pre; overflow-x: auto }</style>
</head><body>${source ? `<img alt="The dry run" src="${source}">` : ""}<pre>${escaped}</pre></body></html>`;
}

module.exports = { jobs, wrongVehicles, planPage };
