// Draws the kept drives of a report, and plays them.

import { Camera } from "./camera.js";
import { drawKept } from "./drawing.js";

const { plans, bodies, drives } = JSON.parse(document.getElementById("data").textContent);
const speed = document.getElementById("speed");
let playing = null; // the card that plays; others halt

class Card {
  constructor(article, drive) {
    this.drive = drive;
    this.canvas = article.querySelector("canvas");
    this.button = article.querySelector("button");
    this.slider = article.querySelector("input");
    this.clock = article.querySelector("output");
    this.camera = new Camera();
    this.path = drive.x.map((x, k) => [x / 100, drive.y[k] / 100]);
    this.index = this.slider.max = this.path.length - 1;
    this.slider.oninput = () => { this.halt(); this.go(Number(this.slider.value)); };
    this.button.onclick = () => (playing === this ? this.halt() : this.play());
    this.go(this.index);
  }

  get last() { return this.path.length - 1; }

  /** Show a moment by its number, from 0. */
  go(index) {
    this.index = index;
    const seconds = this.last ? (this.drive.seconds * index) / this.last : 0;
    this.slider.value = index;
    this.clock.textContent = this.slider.ariaValueText = `${seconds.toFixed(1)} s`;
    this.draw();
  }

  play() {
    playing?.halt();
    playing = this;
    this.button.textContent = "Halt";
    if (this.index === this.last) this.index = 0;
    const [first, begin] = [this.index, performance.now()];
    const tick = (now) => {
      if (playing !== this) return;
      const done = (Math.max(0, now - begin) / 1000) * Number(speed.value) / this.drive.seconds;
      this.go(Math.min(this.last, Math.floor(first + done * this.last)));
      if (this.index === this.last) this.halt();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  halt() {
    if (playing === this) playing = null;
    this.button.textContent = "Play";
  }

  draw() {
    const { canvas, camera, drive, index } = this;
    const size = [canvas.clientWidth, canvas.clientHeight];
    if (!size[0]) return;
    [canvas.width, canvas.height] = size.map((side) => Math.round(side * devicePixelRatio));
    camera.size = size;
    camera.show(drive.bounds, true);
    const [west, south, east, north] = drive.bounds;
    camera.lookAt([(west + east) / 2, (south + north) / 2]);
    const ended = index === this.last;
    const touched = drive.touched.filter((k) => k <= index);
    const moment = {
      pose: [...this.path[index], drive.heading[index] / 1000],
      contact: drive.touched.includes(index),
      hits: [],
      remembered: [],
      leaves: drive.leaves,
      people: drive.people[index],
      doors: ended ? drive.doors.map((ends) => ({ ends, number: null, confidence: null })) : [],
      goal: null,
    };
    drawKept(canvas.getContext("2d"), camera, { plan: plans[drive.plan], body: bodies[drive.body] }, moment, {
      trail: this.path.slice(0, index + 1),
      route: drive.route,
      goals: drive.goals,
      touched: touched.map((k) => this.path[k]),
      aim: ended ? drive.aim : null,
    });
  }
}

const cards = [...document.querySelectorAll("article")].map((article, k) => new Card(article, drives[k]));
const redraw = () => cards.forEach((card) => card.draw());
addEventListener("resize", redraw);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
