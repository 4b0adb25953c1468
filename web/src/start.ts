// The page's first script. It is small, so that it runs while the browser reads the other scripts.
import "dockview/dist/styles/dockview.css";
import "uplot/dist/uPlot.min.css";
import "./style/page.css";
import "./style/drawn.css";
import "./style/panels.css";
import "./style/control.css";
import "./style/images.css";
import "./style/physics.css";
import "./style/plots.css";
import "./style/robots.css";
import "./style/setUp.css";
import "./style/workspace.css";
import "./style/world.css";
import "./early";

void import("./main");
