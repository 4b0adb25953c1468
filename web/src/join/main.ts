import "../style/page.css";
import "../style/panels.css";
import "../style/setUp.css";
import "../style/join.css";
import { JsonServer } from "../api/JsonServer";
import { JoinPage } from "./JoinPage";

const page = new JoinPage(new JsonServer(document.baseURI));
page.show(document.getElementById("app")!);
void page.follow();
