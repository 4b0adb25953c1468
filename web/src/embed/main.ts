// The script that other pages load. It defines the element <gsv-view> once.
import { GsvView } from "./GsvView";

if (!customElements.get("gsv-view")) customElements.define("gsv-view", GsvView);
