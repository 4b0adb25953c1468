import "../style/broker.css";
import { pageCredentials } from "../api/credentials";
import { BrokerApi } from "./BrokerApi";
import { BrokerPage } from "./BrokerPage";

const page = new BrokerPage(new BrokerApi(document.baseURI, pageCredentials(window).fetch));
page.show(document.getElementById("app")!);
void page.load();
