import "uplot/dist/uPlot.min.css";
import "./style.css";
import { App } from "./app.ts";

declare global {
  interface Window {
    /** The page, for tests and for the curious. */
    canopeer: App;
  }
}

const root = document.getElementById("page");
if (root) window.canopeer = new App(root);
