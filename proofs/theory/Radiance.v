(** * Bounds of the radiance, and a ray cut in two

    Claim.  If tau >= 0 and 0 <= C <= Cmax along the ray, then with the
    transmittance T(l) = exp(- int_0^l tau)

      0 <= I(D) <= Cmax (1 - T(D)).

    Whatever the signs, a ray cut at m has

      T(D) = T(m) T',   I(D) = I(m) + T(m) I',

    where T' and I' belong to the rest, a ray of length D - m that starts at m.
    Hence a ray that ends early, at m, leaves out between 0 and Cmax T(m).

    Source.  Max, "Optical Models for Direct Volume Rendering" (1995), for the
    cut; the bounds are folklore.

    Assumptions.  tau(s(l)) and C(s(l)) tau(s(l)) are continuous on [0, D]; the
    optical depth is the integral, no primitive is given.

    The program composites segments because of the cut, and states the last bound
    of a ray that ends at a threshold of the transmittance. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral.
Open Scope R_scope.

(** The rest of a ray, which starts at [m]. *)
Definition shifted (field : R -> R) (m l : R) : R := field (m + l).

Definition continuous_on (f : R -> R) (D : R) : Prop := forall l, 0 <= l <= D -> continuous f l.

Lemma integrable (f : R -> R) (D a b : R) :
  continuous_on f D -> 0 <= a <= b -> b <= D -> ex_RInt f a b.
Proof.
  intros Hf Hab Hb. apply (ex_RInt_continuous (V := R_CompleteNormedModule)).
  intros l. rewrite Rmin_left, Rmax_right by lra. intros Hl. apply Hf. lra.
Qed.

(** The integral has a derivative at 0 and D too, if it is taken of a function
    that goes on continuously beyond: so it becomes a primitive of its integrand. *)
Lemma primitive_exists (f : R -> R) (D : R) :
  0 <= D -> continuous_on f D ->
  exists F, forall l, 0 <= l <= D -> is_derive F l (f l) /\ F l = RInt f 0 l.
Proof.
  intros HD Hf.
  destruct (C0_extension_le f 0 D Hf) as [g [g_continuous g_is_f]].
  exists (RInt g 0). intros l Hl. split.
  - rewrite <- g_is_f by lra.
    apply is_derive_RInt with 0; [| apply g_continuous].
    apply filter_forall. intros x. apply (RInt_correct (V := R_CompleteNormedModule)).
    apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros y _. apply g_continuous.
  - apply RInt_ext. intros x. rewrite Rmin_left, Rmax_right by lra. intros Hx.
    apply g_is_f. lra.
Qed.

Section Ray.
Variables field extinction emission : R -> R.
Variable D : R.
Hypothesis D_nonnegative : 0 <= D.
Hypothesis extinction_continuous : continuous_on (extinction_along field extinction) D.
Hypothesis source_continuous : continuous_on (source field extinction emission) D.

Let tau := extinction_along field extinction.
Let T := transmittance field extinction.

(** Any continuous function, attenuated, has an integral. *)
Lemma attenuated_integrable (f : R -> R) (a b : R) :
  continuous_on f D -> 0 <= a <= b -> b <= D -> ex_RInt (fun l => f l * T l) a b.
Proof.
  intros Hf Hab Hb.
  destruct (primitive_exists _ D D_nonnegative extinction_continuous) as [t Ht].
  apply ex_RInt_ext with (fun l => f l * exp (- t l)).
  - intros l. rewrite Rmin_left, Rmax_right by lra. intros Hl.
    unfold T, transmittance, optical_depth. destruct (Ht l) as [_ ->]; lra.
  - apply integrable with D; [| lra ..]. intros l Hl. apply (continuous_mult f); [now apply Hf |].
    destruct (Ht l Hl) as [t_derivative _]. now apply continuous_exp_opp with (tau l).
Qed.

(** What an emission of 1 all along would give. *)
Lemma absorbed_integral : is_RInt (fun l => tau l * T l) 0 D (1 - T D).
Proof.
  destruct (primitive_exists _ D D_nonnegative extinction_continuous) as [t Ht].
  apply is_RInt_ext with (fun l => tau l * exp (- t l)).
  { intros l. rewrite Rmin_left, Rmax_right by lra. intros Hl.
    unfold T, transmittance, optical_depth. destruct (Ht l) as [_ ->]; lra. }
  unfold T, transmittance, optical_depth. destruct (Ht D) as [_ <-]; [lra |].
  apply (integral_of_derivative (fun l => 1 - exp (- t l))); [lra | | |].
  - destruct (Ht 0) as [_ ->]; [lra |]. rewrite RInt_point. unfold zero. simpl.
    rewrite Ropp_0, exp_0. ring.
  - intros l Hl. destruct (Ht l Hl) as [t_derivative _].
    auto_derive; [now exists (tau l) |].
    replace (Derive (fun x => t x) l) with (tau l) by (symmetry; now apply is_derive_unique).
    ring.
  - intros l Hl. apply (continuous_mult tau); [now apply extinction_continuous |].
    destruct (Ht l Hl) as [t_derivative _]. now apply continuous_exp_opp with (tau l).
Qed.

Theorem radiance_bounds (Cmax : R) :
  (forall l, 0 <= l <= D -> 0 <= extinction (field l)) ->
  (forall l, 0 <= l <= D -> 0 <= emission (field l) <= Cmax) ->
  0 <= radiance field extinction emission D
    <= Cmax * (1 - transmittance field extinction D).
Proof.
  intros tau_nonnegative C_bounds.
  assert (exists_integral := attenuated_integrable _ 0 D source_continuous).
  assert (tau_T : forall l, 0 <= l <= D -> 0 <= tau l * T l).
  { intros l Hl. apply Rmult_le_pos; [now apply tau_nonnegative | left; apply exp_pos]. }
  assert (as_product : forall l,
    integrand field extinction emission l = emission (field l) * (tau l * T l)).
  { intros l. unfold integrand, source, tau, extinction_along, T. ring. }
  split.
  - apply RInt_ge_0; [lra | apply exists_integral; lra |].
    intros l Hl. rewrite as_product.
    apply Rmult_le_pos; [apply C_bounds | apply tau_T]; lra.
  - assert (all_Cmax : is_RInt (fun l => Cmax * (tau l * T l)) 0 D
      (Cmax * (1 - transmittance field extinction D)))
      by exact (is_RInt_scal _ _ _ Cmax _ absorbed_integral).
    rewrite <- (is_RInt_unique _ _ _ _ all_Cmax).
    apply RInt_le; [lra | apply exists_integral; lra | now eexists; apply all_Cmax |].
    intros l Hl. rewrite as_product.
    apply Rmult_le_compat_r; [apply tau_T | apply C_bounds]; lra.
Qed.

(** ** A cut at [m] *)

Variable m : R.
Hypothesis m_inside : 0 <= m <= D.

Lemma shifted_continuous (f : R -> R) :
  continuous_on f D -> continuous_on (fun l => f (m + l)) (D - m).
Proof.
  intros Hf l Hl. apply (continuous_comp (fun x => m + x)); [| apply Hf; lra].
  apply (continuous_plus (fun _ => m) (fun x => x)); [apply continuous_const | apply continuous_id].
Qed.

(** The integral of the rest. *)
Lemma RInt_shifted (f : R -> R) (l : R) :
  ex_RInt f m (m + l) -> RInt (fun x => f (m + x)) 0 l = RInt f m (m + l).
Proof.
  intros Hf. assert (change_of_variable := RInt_comp_lin f 1 m 0 l).
  rewrite Rmult_0_r, Rmult_1_l, Rplus_0_l, (Rplus_comm l m) in change_of_variable.
  rewrite <- change_of_variable by exact Hf.
  apply RInt_ext. intros x _. unfold scal. simpl. unfold mult. simpl.
  now rewrite !Rmult_1_l, Rplus_comm.
Qed.

Lemma transmittance_cut (l : R) :
  0 <= l <= D - m -> T (m + l) = T m * transmittance (shifted field m) extinction l.
Proof.
  intros Hl. unfold T, transmittance. rewrite <- exp_plus, <- Ropp_plus_distr. do 2 f_equal.
  unfold optical_depth.
  rewrite <- (RInt_Chasles (V := R_CompleteNormedModule) _ 0 m (m + l)).
  - now rewrite <- (RInt_shifted tau) by (apply integrable with D; (easy || lra)).
  - apply integrable with D; (easy || lra).
  - apply integrable with D; (easy || lra).
Qed.

Theorem transmittance_split :
  transmittance field extinction D
    = transmittance field extinction m * transmittance (shifted field m) extinction (D - m).
Proof. fold T. rewrite <- transmittance_cut by lra. f_equal. ring. Qed.
End Ray.

Section Cut.
Variables field extinction emission : R -> R.
Variables m D : R.
Hypothesis m_inside : 0 <= m <= D.
Hypothesis extinction_continuous : continuous_on (extinction_along field extinction) D.
Hypothesis source_continuous : continuous_on (source field extinction emission) D.

Theorem radiance_split :
  radiance field extinction emission D
    = radiance field extinction emission m
      + transmittance field extinction m * radiance (shifted field m) extinction emission (D - m).
Proof.
  assert (HD : 0 <= D) by lra.
  assert (on_D := fun a b => attenuated_integrable _ _ _ HD extinction_continuous _ a b
    source_continuous).
  assert (rest := attenuated_integrable (shifted field m) extinction (D - m) ltac:(lra)
    (shifted_continuous _ _ m_inside _ extinction_continuous) _ 0 (D - m)
    (shifted_continuous _ _ m_inside _ source_continuous)).
  unfold radiance at 1.
  rewrite <- (RInt_Chasles (V := R_CompleteNormedModule) _ 0 m D) by (apply on_D; lra).
  unfold plus. simpl. f_equal.
  replace D with (m + (D - m)) at 1 by ring.
  rewrite <- RInt_shifted by (apply on_D; lra).
  rewrite <- (RInt_ext (fun l => scal (transmittance field extinction m)
    (integrand (shifted field m) extinction emission l))).
  - apply (RInt_scal (V := R_CompleteNormedModule)), rest; lra.
  - intros l. rewrite Rmin_left, Rmax_right by lra. intros Hl. unfold integrand.
    rewrite (transmittance_cut _ _ D) by (easy || lra).
    unfold scal, source, shifted. simpl. unfold mult. simpl. ring.
Qed.

Theorem early_termination_bound (Cmax : R) :
  (forall l, 0 <= l <= D -> 0 <= extinction (field l)) ->
  (forall l, 0 <= l <= D -> 0 <= emission (field l) <= Cmax) ->
  0 <= radiance field extinction emission D - radiance field extinction emission m
    <= Cmax * transmittance field extinction m.
Proof.
  intros tau_nonnegative C_bounds. rewrite radiance_split.
  destruct (radiance_bounds (shifted field m) extinction emission (D - m) ltac:(lra)
    (shifted_continuous _ _ m_inside _ extinction_continuous)
    (shifted_continuous _ _ m_inside _ source_continuous) Cmax) as [low high].
  - intros l Hl. apply tau_nonnegative. lra.
  - intros l Hl. apply C_bounds. lra.
  - assert (0 <= Cmax) by (apply Rle_trans with (emission (field 0)); apply C_bounds; lra).
    assert (0 < transmittance field extinction m) by apply exp_pos.
    assert (0 < transmittance (shifted field m) extinction (D - m)) by apply exp_pos.
    set (rest := radiance (shifted field m) extinction emission (D - m)) in *.
    assert (rest <= Cmax) by nra.
    split; nra.
Qed.
End Cut.
