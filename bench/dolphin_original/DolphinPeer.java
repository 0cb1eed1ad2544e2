import groovy.lang.Binding;
import java.io.File;
import java.util.*;
import org.codehaus.groovy.control.CompilerConfiguration;
import pt.lsts.dolphin.dsl.Engine;
import pt.lsts.dolphin.runtime.*;
import pt.lsts.dolphin.runtime.tasks.*;

/**
 * The original Dolphin core on a platform without vehicles, for side-by-side figures. Compiled against a checkout of the
 * original (docs/reference/benchmarks.md says how); nothing of it is part of Lapwing.
 *
 * DolphinPeer run SCRIPT    runs the script as the original does
 * DolphinPeer step SCRIPT   runs the script, then steps the task that it left in `t` without the original's 100 ms sleep
 *                           between steps, and prints the seconds from start to completion
 */
public final class DolphinPeer implements Platform {
  public static void main(String[] arguments) throws Exception {
    Engine engine = Engine.create(new DolphinPeer());
    engine.run(new File(arguments[1]));
    while (engine.isScriptRunning()) Thread.sleep(1);
    if (arguments[0].equals("step")) System.out.println(step((Task) engine.bindingFor("t")));
    System.exit(0);
  }

  private static double step(Task task) {
    Map<Task, List<Node>> allocation = new HashMap<>();
    if (!task.allocate(new NodeSet(), allocation)) throw new IllegalStateException("not allocated");
    TaskExecutor executor = task.getExecutor();
    executor.initialize(allocation);
    long began = System.nanoTime();
    executor.start();
    while (executor.getState() != TaskExecutor.State.COMPLETED) executor.step();
    return (System.nanoTime() - began) * 1e-9;
  }

  public NodeSet getConnectedNodes() { return new NodeSet(); }
  public PlatformTask getPlatformTask(String id) { throw new UnsupportedOperationException(); }
  public void displayMessage(String format, Object... arguments) {}
  public void customizeGroovyCompilation(CompilerConfiguration configuration) {}
  public List<File> getExtensionFiles() { return Collections.emptyList(); }
  public String askForInput(String prompt) { return ""; }
}
