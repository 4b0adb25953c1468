// The script that pages of any site load: it defines the element once.
import { GsvView } from "./GsvView";

if (!customElements.get("gsv-view")) customElements.define("gsv-view", GsvView);
