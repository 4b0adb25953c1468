import "../style/broker.css";
import { BrokerApi } from "./BrokerApi";
import { BrokerPage } from "./BrokerPage";

const page = new BrokerPage(new BrokerApi(document.baseURI));
page.show(document.getElementById("app")!);
void page.load();
